#pragma once

#include <array>

#include "src/core/triangle.h"

namespace lemma {

/// How a line passes a triangle: the volumes that its direction spans with each edge as seen from a point of
/// it. All are <= 0 where it crosses the triangle towards its back, all >= 0 where towards its front.
struct FaceCrossing {
  FaceCrossing(const Triangle& t, const Vec3d& start, const Vec3d& w)
      : corners{Vec3d(t.v0) - start, Vec3d(t.v1) - start, Vec3d(t.v2) - start},
        opposite{dot(w, cross(corners[1], corners[2])), dot(w, cross(corners[2], corners[0])),
                 dot(w, cross(corners[0], corners[1]))} {}

  /// Negative if the direction goes to the back, 0 if along.
  [[nodiscard]] double sum() const { return opposite[0] + opposite[1] + opposite[2]; }
  [[nodiscard]] bool passes_to_back() const {
    return !(opposite[0] > 0 || opposite[1] > 0 || opposite[2] > 0);
  }
  /// Where, relative to the start; sum() is not 0.
  [[nodiscard]] Vec3d point() const {
    return (corners[0] * opposite[0] + corners[1] * opposite[1] + corners[2] * opposite[2]) * (1 / sum());
  }

  std::array<Vec3d, 3> corners;
  std::array<double, 3> opposite;  // of the edge that does not meet the corner
};

}  // namespace lemma
