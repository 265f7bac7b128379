#pragma once

namespace lemma {

/// Chance of a false alarm that each of `tests` independent tests may have so that all together have
/// `false_alarm` (Sidak). Where the tests depend on each other, all together have less.
[[nodiscard]] double sidak(double false_alarm, double tests);

/// The number that a standard normal variable exceeds in absolute value with probability `chance`.
[[nodiscard]] double z_limit(double chance);

/// The standard normal number that lies as far out as t does in Student's distribution with `freedom` degrees
/// of freedom, with the sign of t: makes tests of different freedom comparable. At most 37 in absolute value,
/// where the tails of double end.
[[nodiscard]] double z_of_t(double t, double freedom);

/// The number that a chi-square variable of `freedom` degrees of freedom stays below with probability
/// `chance`.
/// @param freedom  above 0
[[nodiscard]] double chi_square_quantile(double chance, double freedom);

}  // namespace lemma
