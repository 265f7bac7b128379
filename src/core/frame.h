#pragma once

#include "src/core/vec.h"

namespace lemma {

/// Right-handed orthonormal frame; n is its local z axis.
struct Frame {
  Vec3 s, t, n;

  [[nodiscard]] Vec3 to_local(const Vec3& w) const { return {dot(w, s), dot(w, t), dot(w, n)}; }
  [[nodiscard]] Vec3 to_world(const Vec3& w) const { return s * w.x + t * w.y + n * w.z; }
};

/// A frame around the unit vector n, without branch or loss of precision near any axis.
/// Source: Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017, listing 3.
[[nodiscard]] inline Frame frame_around(const Vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

}  // namespace lemma
