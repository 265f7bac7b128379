#pragma once

#include <cmath>

#include "src/core/vec.h"

namespace lemma {

/// Any unit vector at right angles to the unit vector n.
[[nodiscard]] inline Vec3d tangent(const Vec3d& n) {
  return normalize(cross(n, std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)));
}

}  // namespace lemma
