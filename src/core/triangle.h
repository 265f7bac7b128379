#pragma once

#include <algorithm>

#include "src/core/vec.h"

namespace lemma {

/// Three vertices [scene units]; counter-clockwise seen from the side its normal points to.
struct Triangle {
  Vec3 v0, v1, v2;
};

/// (v1 - v0) x (v2 - v0), in double: twice the area along the normal.
[[nodiscard]] inline Vec3d area_vector(const Triangle& t) {
  const Vec3d v0(t.v0);
  return cross(Vec3d(t.v1) - v0, Vec3d(t.v2) - v0);
}

/// Six times the signed volume that x spans with the triangle: positive on the side of its normal.
[[nodiscard]] inline double side_of(const Triangle& t, const Vec3& x) {
  return dot(Vec3d(x) - Vec3d(t.v0), area_vector(t));
}

[[nodiscard]] inline double area(const Triangle& t) {
  return 0.5 * length(area_vector(t));
}

[[nodiscard]] inline Vec3 geometric_normal(const Triangle& t) {
  return Vec3(normalize(area_vector(t)));
}

[[nodiscard]] inline double longest_edge2(const Triangle& t) {
  const Vec3d e0(t.v1 - t.v0), e1(t.v2 - t.v1), e2(t.v0 - t.v2);
  return std::max(std::max(dot(e0, e0), dot(e1, e1)), dot(e2, e2));
}

/// (longest edge)^2 / (2 area): 1.15 for an equilateral triangle, large for slivers. Rounding errors of a
/// hit's t grow with it.
[[nodiscard]] inline double sliver_ratio(const Triangle& t) {
  return longest_edge2(t) / length(area_vector(t));
}

/// The point with barycentric coordinates b1, b2, in double: it lies in the triangle's plane to 2^-50 or so.
[[nodiscard]] inline Vec3d point_at(const Triangle& t, double b1, double b2) {
  return Vec3d(t.v0) * (1.0 - b1 - b2) + Vec3d(t.v1) * b1 + Vec3d(t.v2) * b2;
}

}  // namespace lemma
