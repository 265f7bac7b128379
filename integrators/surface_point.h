#pragma once

#include "src/core/error_bound.h"

namespace lemma {

/// The point of a triangle that a ray hits, on the side that the ray comes from.
struct SurfacePoint {
  /// @param b1, b2     of the hit
  /// @param direction  of the ray
  SurfacePoint(const Triangle& triangle, float b1, float b2, const Vec3& direction) {
    const Vec3d of_winding = normalize(area_vector(triangle));
    behind = dot(of_winding, Vec3d(direction)) > 0;
    normal = of_winding * (behind ? -1.0 : 1.0);
    origin = offset_origin(point_at(triangle, b1, b2), normal, triangle);
  }

  bool behind;   // the winding's normal points away from that side
  Vec3d normal;  // unit, to that side
  Vec3 origin;   // of rays that leave to that side, off the surface by its error bound
};

}  // namespace lemma
