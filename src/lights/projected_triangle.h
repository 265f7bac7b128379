#pragma once

#include <array>
#include <cstddef>

#include "src/core/triangle.h"

namespace lemma {

/// The part of a triangle above the horizon of n as seen from x, projected from the unit sphere onto the
/// plane of n, in double. A uniform point of this projection is a direction of density cos(theta) /
/// projected_solid_angle().
/// Sources: Arvo, Stratified Sampling of 2-Manifolds, SIGGRAPH 2001 course 29 (the map by area functions);
/// Peters, BRDF Importance Sampling for Polygonal Lights, SIGGRAPH 2021 (sectors between two ellipses).
class ProjectedTriangle {
 public:
  /// @param n  unit
  ProjectedTriangle(const Triangle& triangle, const Vec3& x, const Vec3& n);

  /// Integral of max(0, n . w) over the triangle, in [0, pi] [sr]; 0 when x lies in its plane.
  [[nodiscard]] double projected_solid_angle() const { return area_; }

  /// Whether sample() keeps its accuracy: the smaller the part, the more its area is a difference of large
  /// ones.
  [[nodiscard]] bool can_be_sampled() const { return area_ > kSmallestArea; }

  /// Unit direction from x, for u uniform in [0,1)^2.
  [[nodiscard]] Vec3d sample(const Vec2& u) const;

 private:
  static constexpr double kSmallestArea = 1e-9;

  /// The projection of the great circle with the plane m . w = 0: half an ellipse about the origin.
  class Ellipse {
   public:
    Ellipse() = default;
    explicit Ellipse(const Vec3d& m) : m_(m), flatness_(std::abs(m.z) / length(m)) {}

    /// Area between the origin and the ellipse from direction `from` to `to`, less than pi apart.
    [[nodiscard]] double area(const Vec3d& from, const Vec3d& to) const;
    /// Squared height of the great circle over the unit direction d, 1 - radius^2 of the ellipse.
    [[nodiscard]] double height2(const Vec3d& d) const;

   private:
    Vec3d m_;
    double flatness_ = 0;  // short over long axis; 0 for no ellipse at all
  };

  /// What lies between two azimuths and two ellipses.
  struct Sector {
    Vec3d from, to;  // unit, in the plane
    Ellipse outer, inner;
    double area = 0;

    /// The part up to the direction `to`.
    [[nodiscard]] double area_up_to(const Vec3d& d) const;
    /// The direction up to which the part has this area.
    [[nodiscard]] Vec3d direction_at(double part) const;
  };

  class Polygon;
  void add_sector(const Vec3d& from, const Vec3d& to, const Ellipse& outer, const Ellipse& inner);

  Vec3d s_, t_, n_;
  double area_ = 0;
  std::size_t count_ = 0;
  std::array<Sector, 8> sectors_;  // four edges, of which three at most are wide enough to be halved
};

}  // namespace lemma
