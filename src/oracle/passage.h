#pragma once

#include <array>
#include <cstdint>

#include "src/core/ray.h"
#include "src/core/triangle.h"

namespace lemma {

/// A ray in double, with the shear of accel/watertight.h: its largest axis kz, and the lateral coordinates of
/// points beside it.
struct LongRay {
  explicit LongRay(const Ray& ray);

  /// Where a point passes the ray: x and y across, z along the largest axis [scene units].
  [[nodiscard]] Vec3d beside(const Vec3& point) const;

  Vec3d origin, direction;
  double length;  // of the direction
  double t_min, t_max;
  int kx, ky, kz;
};

/// Largest coordinate difference between the origin and the box of the triangle: the size that roundings of
/// v - o are relative to.
[[nodiscard]] double reach_of(const LongRay& ray, const Triangle& triangle);

/// How a ray passes a triangle, as far as float32 can tell: every answer that a sound float32 test can give
/// lies within the bounds below. They are wider than double's own errors by 2^25 and more, so that what they
/// leave certain is certain in real arithmetic. u is kRoundoff, M the size of reach_of, |e| the edge, |d| the
/// direction, kappa the sliver_ratio, cos that between ray and plane.
struct Passage {
  enum class Answer : std::uint8_t { no, unsure, yes };

  std::uint32_t triangle = 0;
  std::array<std::int8_t, 3> side{};  // of the edge opposite each vertex: sign of its edge function, or 0
  Answer inside = Answer::no;         // does the ray's line pass through the triangle?
  Answer in_range = Answer::no;       // is t in (t_min, t_max)?
  bool grazing = false;               // the plane is seen edge-on: t may be anything within the triangle
  double t = 0;                       // of the plane
  double tolerance = 0;               // how far off a computed t may be
  double lo = 0, hi = 0;              // every computed t lies in [lo, hi]

  [[nodiscard]] bool may_hit() const { return inside != Answer::no && in_range != Answer::no; }
  [[nodiscard]] bool must_hit() const { return inside == Answer::yes && in_range == Answer::yes; }
  [[nodiscard]] bool touches_edge() const { return side[0] == 0 || side[1] == 0 || side[2] == 0; }
};

/// An edge function d . (a x e) up to this times u M |e| |d| may be seen with either sign. Measured largest
/// values over 7e6 rays: 1.4 for the watertight test, 2.2 for Embree's ROBUST one; a margin of 7 is left.
inline constexpr double kEdgeBand = 16;

/// A computed t errs by at most this times kappa u M / (cos |d|). Measured: 8 for the worst test tried.
inline constexpr double kDistanceBand = 32;

/// At the ends of the range a computed t errs by at most this times u M / (cos |d|): sqrt(3) 4 < 7, as
/// derived at kPlaneError (src/core/error_bound.h), which is larger so that rays from an offset origin are
/// decided.
inline constexpr double kRangeBand = 7;

/// Nothing further than this times u M from a triangle's box can be taken to pass through the triangle: both
/// the shear and Embree's boxes move a vertex by a few u M.
inline constexpr double kBoxBand = 32;

[[nodiscard]] Passage passage(const LongRay& ray, const Triangle& triangle, std::uint32_t index);

}  // namespace lemma
