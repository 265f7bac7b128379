#pragma once

#include <optional>
#include <vector>

#include "tests/support/images.h"

namespace lemma::test {

/// One estimator of a family and what it takes to be precise.
struct Run {
  Configuration configuration;
  std::uint32_t spp = 1;
};

/// The bias [part of the image mean] that the environment variable LEMMA_AGREEMENT asks to see, in percent:
/// LEMMA_AGREEMENT=0.1. Then each run takes as many samples as its noise, measured by a first rendering,
/// says, up to kMostEffort times the usual, and families are the products of all options. Else nothing.
[[nodiscard]] std::optional<double> wanted_bias();

inline constexpr double kMostEffort = 64;

/// What the usual samples must show at least: a factor of 2 in a weight or density is far beyond it in a run
/// that depends on it.
inline constexpr double kUsualBias = 0.1;

/// Chance that one of the comparisons of a family fails although all estimators have the same mean: half of
/// it for image means, half for blocks. Seeds are fixed, so a test that passes does so always; this is the
/// chance of having to look at one after a change that is right.
inline constexpr double kFalseAlarm = 1e-3;

/// Renders every run with 32 seeds of its own, so that their errors are independent, and compares the means
/// of the image and of its blocks of 8 x 8 pixels with those of the first run: Welch's t against Student's
/// limit for the fewest degrees of freedom it can have, with Sidak's correction. Limits so follow from the
/// number of comparisons and the measured noise alone. Prints a row a run, with the bias that it sees: the
/// one whose t is expected at the limit.
void expect_equal_means(const Scene& scene, std::vector<Run> runs);

/// All light samplings with both heuristics of `mis`; the other accelerator, sampler and roulette; light
/// samples alone and BRDF samples alone. Those that need more samples for the same error get them.
[[nodiscard]] std::vector<Run> all_estimators(std::uint32_t spp);

}  // namespace lemma::test
