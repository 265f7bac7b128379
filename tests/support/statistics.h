#pragma once

#include <functional>
#include <span>

namespace lemma::test {

/// Mean of independent values with its standard error.
struct Estimate {
  double mean = 0, standard_error = 0;
  int count = 0;
};

[[nodiscard]] Estimate estimate(std::span<const double> values);

/// Difference of two estimates in units of its standard error (Welch). Nearly normal for 16 and more values
/// each.
[[nodiscard]] double z_score(const Estimate& a, const Estimate& b);

/// The |z| that a standard normal variable exceeds in one of `tests` independent tests with probability
/// `false_alarm` at all (Sidak's correction).
[[nodiscard]] double z_limit(double false_alarm, int tests);

/// The same for Student's t with `freedom` degrees of freedom, which means of few values follow.
[[nodiscard]] double t_limit(double false_alarm, int tests, double freedom);

/// Probability that a chi-square variable with `freedom` degrees of freedom exceeds `value`.
[[nodiscard]] double chi_square_tail(double value, double freedom);

/// Tail probability of the counts of independent draws that should fall into cells by these shares. Cells
/// with fewer than 5 expected are put together.
[[nodiscard]] double chi_square_test(std::span<const double> counts, std::span<const double> shares);

}  // namespace lemma::test
