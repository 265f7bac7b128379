#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "src/core/triangle.h"

namespace lemma {

/// Unit roundoff of float32: the relative error of one rounding.
inline constexpr double kRoundoff = 0x1p-24;

/// A hit computed in float32 lies within kPlaneError * kRoundoff * M of the triangle's plane, where M is the
/// largest coordinate difference between the ray's origin and a vertex. Rounding v - o costs one unit of u M
/// a coordinate, the shear of the watertight test (accel/watertight.h) three more, and the normal sums them
/// over three axes with at most sqrt(3) times its largest share: sqrt(3) * 4 = 7 < 8. Embree's ROBUST test
/// keeps the same bound on triangles that are no slivers: of 2.4 million rays none finds the plane that it
/// left (tests/parity/self_intersection_test.cpp).
inline constexpr double kPlaneError = 8;

/// Next float towards +infinity or -infinity, whichever `direction` points to; x itself when direction is 0.
/// As std::nextafter, which is a call; beyond the range of float x stays.
[[nodiscard]] inline float next_float_towards(float x, double direction) {
  if (direction == 0 || !std::isfinite(x)) return x;
  const bool up = direction > 0;
  if (x == 0) return std::copysign(std::numeric_limits<float>::denorm_min(), up ? 1.0f : -1.0f);
  const auto bits = std::bit_cast<std::uint32_t>(x);  // of sign and magnitude, in the order of magnitudes
  return std::bit_cast<float>((x > 0) == up ? bits + 1 : bits - 1);
}

/// The origin for rays that leave the point p of a triangle to the side its unit normal n points to: the
/// float nearest above p that no such ray, once rounded, can be found to hit the triangle's plane again.
/// @param p  in the plane up to double precision (point_at)
/// @param n  unit, on the side of the leaving rays; in double, since its own rounding moves the offset point
/// Source: Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 6.8.6, with the bound of the plane
/// above in place of the hit's own: here p is computed in double and rounded once.
[[nodiscard]] inline Vec3 offset_origin(const Vec3d& p, const Vec3d& n, const Triangle& t) {
  const double m =
      std::max({max_norm(Vec3d(t.v0) - p), max_norm(Vec3d(t.v1) - p), max_norm(Vec3d(t.v2) - p)});
  const Vec3d above = p + n * (kPlaneError * kRoundoff * m);
  Vec3 origin;
  for (int k = 0; k < 3; ++k) origin[k] = next_float_towards(static_cast<float>(above[k]), n[k]);
  return origin;
}

}  // namespace lemma
