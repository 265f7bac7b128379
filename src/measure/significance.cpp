#include "src/measure/significance.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace lemma {
namespace {

constexpr double kSmallestTail = 1e-300;
constexpr double kLargestFreedom = 1e6;  // beyond, Student's distribution is the normal one to 1e-5 at z = 6

}  // namespace

double sidak(double false_alarm, double tests) {
  return -std::expm1(std::log1p(-false_alarm) / tests);
}

double z_limit(double chance) {
  return boost::math::quantile(boost::math::complement(boost::math::normal(), chance / 2));
}

double z_of_t(double t, double freedom) {
  if (freedom > kLargestFreedom) return std::clamp(t, -37.0, 37.0);
  if (!std::isfinite(t)) return std::copysign(37.0, t);
  const boost::math::students_t distribution(freedom);
  const double tail = boost::math::cdf(boost::math::complement(distribution, std::abs(t)));
  return std::copysign(z_limit(2 * std::max(tail, kSmallestTail)), t);
}

double chi_square_quantile(double chance, double freedom) {
  return boost::math::quantile(boost::math::chi_squared(freedom), chance);
}

}  // namespace lemma
