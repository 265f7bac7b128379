#pragma once

#include <cstdint>

#include "src/core/rgb.h"
#include "src/core/triangle.h"

namespace lemma {

inline constexpr std::uint32_t kNoEmitter = 0xFFFFFFFFu;  // in place of an index

/// A triangle that emits the constant radiance to the side its winding's normal points to, nothing to the
/// other.
struct Emitter {
  Triangle shape;              // wound so that the normal points to the emitting side
  Rgb radiance;                // [W m^-2 sr^-1]
  std::uint32_t triangle = 0;  // index in the scene
  std::uint32_t light = 0;     // index of the light (one material) it belongs to
};

/// Whether x lies strictly on the emitting side. Light sampling and emission at a hit both ask this one
/// function, so that they never disagree about a point near the plane.
[[nodiscard]] inline bool emits_towards(const Emitter& e, const Vec3& x) {
  return side_of(e.shape, x) > 0;
}

}  // namespace lemma
