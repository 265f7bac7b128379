#pragma once

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

/// The probability to go on.
/// @param depth  number of the scattering event, from 1
[[nodiscard]] float survival(Roulette roulette, int depth, const Rgb& throughput);

/// Ends the path at random, or divides its throughput by the probability q to go on, so that the mean stays.
/// @return whether the path goes on
[[nodiscard]] bool survives(float q, Rgb& throughput, Sampler& random);

/// Whether the variance is infinite where paths bounce between surfaces of an albedo without end, as in a
/// closed scene: the second moment of the k-th bounce grows with (albedo^2 / q)^k, so that `fixed` needs
/// albedos below sqrt(0.6) = 0.775. `throughput` is never capped below 1 for the same reason.
[[nodiscard]] bool has_infinite_variance(Roulette roulette, float albedo);

}  // namespace lemma
