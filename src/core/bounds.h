#pragma once

#include <limits>
#include <span>

#include "src/core/triangle.h"

namespace lemma {

/// Axis-aligned box; empty (lo > hi) until something is added.
struct Bounds {
  Vec3 lo{std::numeric_limits<float>::infinity()};
  Vec3 hi{-std::numeric_limits<float>::infinity()};

  void add(const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  void add(const Triangle& t) {
    add(t.v0);
    add(t.v1);
    add(t.v2);
  }
  [[nodiscard]] bool empty() const { return lo.x > hi.x; }
};

[[nodiscard]] inline Bounds bounds_of(std::span<const Triangle> triangles) {
  Bounds b;
  for (const Triangle& t : triangles) b.add(t);
  return b;
}

}  // namespace lemma
