#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/lights/light_sampler.h"
#include "src/lights/whole_light.h"
#include "src/lights/whole_weight.h"

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
  [[nodiscard]] WholeOutline operator[](std::size_t i) const {
    return {{x[i], y[i], z[i]}, {rest_x[i], rest_y[i], rest_z[i]}, radius2[i], luminance[i]};
  }
};

[[nodiscard]] WholeOutline outline_of(const WholeLight& light, float radiance_luminance);

/// The weights of a block's lights as seen from a point, in float32, compiled for one instruction set.
struct WeighWholes {
  /// Of each place whole_weight().
  /// @param count  places that are asked for, from the first on
  void (*function)(const WholeBlock& block, std::size_t count, const LightQuery& at,
                   WholeBlock::Values& weights);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the same weights, bit for bit.
[[nodiscard]] const std::vector<WeighWholes>& all_weigh_wholes();

}  // namespace lemma
