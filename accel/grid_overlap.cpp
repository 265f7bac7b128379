#include "accel/grid_overlap.h"

#include <algorithm>

namespace lemma {

BoxOverlap::BoxOverlap(const Triangle& triangle, const Vec3d& half) {
  add_axis(area_vector(triangle), triangle, half);
  const Vec3d v0(triangle.v0), v1(triangle.v1), v2(triangle.v2);
  for (const Vec3d& edge : {v1 - v0, v2 - v1, v0 - v2}) {
    add_axis({0, -edge.z, edge.y}, triangle, half);
    add_axis({edge.z, 0, -edge.x}, triangle, half);
    add_axis({-edge.y, edge.x, 0}, triangle, half);
  }
}

void BoxOverlap::add_axis(const Vec3d& direction, const Triangle& triangle, const Vec3d& half) {
  const double size = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  if (size == 0) return;  // an edge along a box axis, or no area: separates nothing
  const double p0 = dot(direction, Vec3d(triangle.v0));
  const double p1 = dot(direction, Vec3d(triangle.v1));
  const double p2 = dot(direction, Vec3d(triangle.v2));
  const double reach =
      std::abs(direction.x) * half.x + std::abs(direction.y) * half.y + std::abs(direction.z) * half.z;
  // Projections of coordinates up to m err by less than 8 roundings of size * m in double.
  const double coordinate =
      std::max({max_norm(triangle.v0), max_norm(triangle.v1), max_norm(triangle.v2)}) + max_norm(half);
  const double slack = 8 * 0x1p-53 * size * coordinate;
  axes_[static_cast<std::size_t>(count_++)] = {direction, std::min({p0, p1, p2}), std::max({p0, p1, p2}),
                                               reach + slack};
}

bool BoxOverlap::with_box_at(const Vec3d& centre) const {
  for (int i = 0; i < count_; ++i) {
    const Axis& axis = axes_[static_cast<std::size_t>(i)];
    const double c = dot(axis.direction, centre);
    if (axis.lo > c + axis.radius || axis.hi < c - axis.radius) return false;
  }
  return true;
}

}  // namespace lemma
