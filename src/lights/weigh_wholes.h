#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/lights/light_sampler.h"
#include "src/lights/whole_light.h"

namespace lemma {

/// Some whole lights, as structure of arrays, so that all are weighed at a time. Places may stay empty.
struct WholeBlock {
  static constexpr std::size_t kSize = 16;
  using Values = std::array<float, kSize>;

  alignas(64) Values x{}, y{}, z{};     // centre, rounded, and ...
  Values rest_x{}, rest_y{}, rest_z{};  // ... what was rounded off
  Values radius2{};                     // squared; 0: no light here
  Values luminance{};

  void set(std::size_t place, const WholeLight& light, float radiance_luminance);
};

/// The weights of a block's lights as seen from a point, in float32, compiled for one instruction set.
struct WeighWholes {
  /// Luminance x solid angle of the sphere's cone x about the mean over the cone of max(0, cosine), which is
  /// that of its largest and its smallest value, x the mean of what is reflected (Reflection::mean). Positive
  /// if the cone reaches above the horizon, and up to 10^-5 below. -1 where there is no light, or x is so
  /// near that the light cannot be sampled as a whole (SphereCone::can_be_sampled, up to rounding).
  /// @param count  places that are asked for, from the first on
  void (*function)(const WholeBlock& block, std::size_t count, const LightQuery& at,
                   WholeBlock::Values& weights);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the same weights, bit for bit.
[[nodiscard]] const std::vector<WeighWholes>& all_weigh_wholes();

}  // namespace lemma
