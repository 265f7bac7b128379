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

double chi_square_test(std::span<const double> counts, std::span<const double> shares) {
  double draws = 0;
  for (const double c : counts) draws += c;
  double statistic = 0, rare_count = 0, rare_expected = 0;
  int cells = 0;
  const auto compare = [&](double count, double expected) {
    statistic += (count - expected) * (count - expected) / expected;
    ++cells;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = draws * shares[i];
    if (expected >= 5) {
      compare(counts[i], expected);
    } else {
      rare_count += counts[i], rare_expected += expected;
    }
  }
  // What is too rare even together may not be there at all, but for a chance below e^-40.
  if (rare_expected >= 5) compare(rare_count, rare_expected);
  if (rare_expected < 5 && rare_count > 60) return 0;
  return cells > 1 ? chi_square_tail(statistic, cells - 1) : 1;
}

double chi_square_tail(double value, double freedom) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), value));
}

}  // namespace lemma::test
