#pragma once

#include <span>

#include "src/core/named.h"
#include "src/core/rgb.h"
#include "src/core/sampler.h"

namespace lemma {

/// How the length of a path is decided.
enum class Roulette {
  fixed,      // survive every scattering with probability 0.6, as in the report's section 5
  throughput  // survive with the path's own throughput, from the third scattering on
};

[[nodiscard]] std::span<const Named<Roulette>> roulettes();

/// Ends the path at random, or divides its throughput by the probability to go on, so that the mean stays.
/// The variance of `fixed` is infinite where albedos reach sqrt(0.6) = 0.775 in a closed scene: the second
/// moment of the k-th term grows with (albedo^2 / 0.6)^k. `throughput` is never capped below 1 for the same
/// reason.
/// @param depth  number of the scattering event, from 1
/// @return whether the path goes on
[[nodiscard]] bool survives(Roulette roulette, int depth, Rgb& throughput, Sampler& random);

}  // namespace lemma
