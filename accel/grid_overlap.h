#pragma once

#include <array>

#include "src/core/triangle.h"

namespace lemma {

/// Does a triangle overlap boxes of one size? Conservative: says yes in doubt, so that rounding never loses a
/// triangle. Separating axes of plane and edges; the three of the box are left to the caller, who tries only
/// boxes within the triangle's bounds. Source: Akenine-Moeller, Fast 3D Triangle-Box Overlap Testing, JGT
/// 6(1), 2001.
class BoxOverlap {
 public:
  /// @param half  half the box's size on each axis
  BoxOverlap(const Triangle& triangle, const Vec3d& half);

  [[nodiscard]] bool with_box_at(const Vec3d& centre) const;

 private:
  /// The triangle covers [lo, hi] of the axis; the box reaches `radius` from its centre.
  struct Axis {
    Vec3d direction;
    double lo, hi, radius;
  };
  void add_axis(const Vec3d& direction, const Triangle& triangle, const Vec3d& half);

  std::array<Axis, 10> axes_;
  int count_ = 0;
};

}  // namespace lemma
