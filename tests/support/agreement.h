#pragma once

#include <vector>

#include "tests/support/images.h"

namespace lemma::test {

/// One estimator of a family and what it takes to be precise.
struct Run {
  Configuration configuration;
  std::uint32_t spp = 1;
};

/// How many times the usual samples are taken: the number in the environment variable LEMMA_AGREEMENT,
/// else 1. With more than 1 families are the products of all options as well. The bias that can be seen falls
/// with its root: to 0.1 % of the mean takes 64 where 0.8 % is what the table says.
[[nodiscard]] std::uint32_t agreement_effort();

/// Chance that one of the comparisons of a family fails although all estimators have the same mean: half of
/// it for image means, half for blocks. Seeds are fixed, so a test that passes does so always; this is the
/// chance of having to look at one after a change that is right.
inline constexpr double kFalseAlarm = 1e-3;

/// Renders every run with 32 seeds of its own, so that their errors are independent, and compares the means
/// of the image and of its blocks of 8 x 8 pixels with those of the first run: Welch's t against Student's
/// limit for the fewest degrees of freedom it can have, with Sidak's correction. Prints a row a run.
/// @param detectable  part of the mean that a bias must have at most, with the usual samples, for its t to
/// be expected at the limit; a run that is not as precise fails
void expect_equal_means(const Scene& scene, std::vector<Run> runs, double detectable);

/// All light samplings with both heuristics of `mis`; the other accelerator, sampler and roulette; light
/// samples alone and BRDF samples alone. Those that need more samples for the same error get them.
[[nodiscard]] std::vector<Run> all_estimators(std::uint32_t spp);

}  // namespace lemma::test
