#pragma once

#include <algorithm>
#include <span>

#include "src/core/named.h"
#include "src/core/rgb.h"
#include "src/core/sampler.h"

namespace lemma {

/// How the length of a path is decided.
enum class Roulette {
  fixed,      // survive every scattering with probability 0.6, as in the report's section 5
  throughput  // survive with three times the path's throughput, at most 1, from the third scattering on
};

[[nodiscard]] std::span<const Named<Roulette>> roulettes();

inline constexpr float kFixedSurvival = 0.6f;  // of Roulette::fixed, the report's

// Measured as relMSE x processor time against the plain throughput (1 in place of 3): 1.45 times as efficient
// in the Cornell box, 1.08 in the Veach scene; 2 and 4 gain less, as do first depths of 2 and 4.
inline constexpr int kFirstThroughputDepth = 3;
inline constexpr float kSurvivalPerThroughput = 3;
inline constexpr float kSmallestSurvival = 0.05f;  // bounds the weight of the paths that go on

/// The probability to go on.
/// @param depth  number of the scattering event, from 1
[[nodiscard]] inline float survival(Roulette roulette, int depth, const Rgb& throughput) {
  if (roulette == Roulette::fixed) return kFixedSurvival;
  if (depth < kFirstThroughputDepth) return 1;
  return std::clamp(kSurvivalPerThroughput * max_channel(throughput), kSmallestSurvival, 1.0f);
}

/// Ends the path at random, or divides its throughput by the probability q to go on, so that the mean stays.
/// @return whether the path goes on
[[nodiscard]] inline bool survives(float q, Rgb& throughput, Sampler& random) {
  if (q == 1) return true;
  if (random.next() >= q) return false;
  throughput *= 1 / q;
  return true;
}

/// The second moment of the factor by which the throughput changes at a vertex, over albedo^2, at most. The
/// factor of one BRDF sample is the albedo. That of mis-report is the sum of both its samples' factors a and
/// b: on Lambert's surfaces neither exceeds the albedo and their means make it up, so that E (a + b)^2 <=
/// albedo (E a + E b) + 2 E a E b <= 1.5 albedo^2 (1.05 where all directions see light of one radiance).
inline constexpr float kOneSampleSpread = 1, kTwoSampleSpread = 1.5f;

/// Whether the variance may be infinite where paths bounce between surfaces of an albedo without end, as in a
/// closed scene: the second moment of the k-th bounce grows with (spread albedo^2 / q)^k, so that `fixed`
/// needs albedos below sqrt(0.6) = 0.775, and below 0.632 with mis-report. `throughput` is never capped below
/// 1 for the same reason.
[[nodiscard]] bool has_infinite_variance(Roulette roulette, float albedo, float spread);

}  // namespace lemma
