#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "src/lights/emitter.h"

namespace lemma {

/// Some emitters, as structure of arrays, so that several are weighed at a time.
struct EmitterBlock {
  static constexpr std::size_t kSize = 64;
  using Values = std::array<float, kSize>;

  alignas(64) Values v0_x{}, v0_y{}, v0_z{};
  Values v1_x{}, v1_y{}, v1_z{}, v2_x{}, v2_y{}, v2_z{};
  Values normal_x{}, normal_y{}, normal_z{};  // area vector
  Values luminance{};

  /// @param emitters  up to kSize, at least one; the places left over repeat the last one, at luminance 0
  explicit EmitterBlock(std::span<const Emitter> emitters);

  [[nodiscard]] Triangle triangle(std::size_t i) const;
};

/// Where emitters are looked at from.
struct Viewpoint {
  Vec3 x;
  Vec3 n;  // unit shading normal
};

/// The weights of a block's emitters as seen from a point, in float32, compiled for one instruction set. A
/// weight is positive exactly if the emitter has luminance and emits_towards() the point.
struct WeighEmitters {
  using Function = void (*)(const EmitterBlock& block, const Viewpoint& from, EmitterBlock::Values& weights);

  /// Luminance x solid angle.
  Function by_solid_angle;
  /// Luminance x projected solid angle: exactly where the triangle is so large that it makes a difference
  /// (ProjectedTriangle), else solid angle x mean of max(0, cosine) at the vertices. 0 for emitters below the
  /// horizon.
  Function by_projected_solid_angle;
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the same weights, bit for bit.
[[nodiscard]] const std::vector<WeighEmitters>& all_weigh_emitters();

}  // namespace lemma
