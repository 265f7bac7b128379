#pragma once

#include <cmath>

#include "src/core/vec.h"

namespace lemma {

/// Any unit vector at right angles to the unit vector n: as frame_around, in double.
[[gnu::always_inline, nodiscard]] inline Vec3d tangent(const Vec3d& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z);
  return {1 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

}  // namespace lemma
