#include "tests/support/statistics.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace lemma::test {
namespace {

/// Chance of a single two-sided test, halved for one tail, so that `tests` of them together err with
/// `false_alarm`.
double tail(double false_alarm, int tests) {
  return -std::expm1(std::log1p(-false_alarm) / tests) / 2;
}

}  // namespace

Estimate estimate(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0;
  for (const double v : values) mean += v / n;
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n - 1) / n), static_cast<int>(values.size())};
}

double z_score(const Estimate& a, const Estimate& b) {
  return (a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

double z_limit(double false_alarm, int tests) {
  return boost::math::quantile(boost::math::complement(boost::math::normal(), tail(false_alarm, tests)));
}

double t_limit(double false_alarm, int tests, double freedom) {
  return boost::math::quantile(
      boost::math::complement(boost::math::students_t(freedom), tail(false_alarm, tests)));
}

double chi_square_tail(double value, double freedom) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), value));
}

}  // namespace lemma::test
