#pragma once

#include "src/core/vec.h"

namespace lemma {

/// The cone of directions from x that meet a sphere, in double.
class SphereCone {
 public:
  SphereCone(const Vec3d& centre, double radius, const Vec3& x);

  /// Whether x lies outside the sphere by so much that a polyhedron within it still fills most of the cone:
  /// at 1.01 radii or more.
  [[nodiscard]] static bool can_be_sampled(const Vec3d& centre, double radius, const Vec3& x) {
    const Vec3d to_centre = centre - Vec3d(x);
    return can_be_sampled(radius, dot(to_centre, to_centre));
  }
  [[nodiscard]] bool can_be_sampled() const { return can_be_sampled_; }

  /// Unit.
  [[nodiscard]] const Vec3d& axis() const { return axis_; }

  /// Of the half angle.
  [[nodiscard]] double one_minus_cos() const { return one_minus_cos_; }

  /// [sr]
  [[nodiscard]] double solid_angle() const;

  /// Whether a unit direction lies within.
  [[nodiscard]] bool holds(const Vec3d& w) const;

  /// Unit direction, uniform over the cone, for u uniform in [0,1)^2.
  [[nodiscard]] Vec3d sample(const Vec2& u) const;

  /// The squared sine of the largest half angle that can be sampled.
  static constexpr float kLargestSin2 = 0.98f;

 private:
  static bool can_be_sampled(double radius, double distance2) {
    return radius * radius < kLargestSin2 * distance2;
  }

  Vec3d axis_;
  double one_minus_cos_ = 0;  // of the half angle: 1 - cos = sin^2 / (1 + cos), which does not cancel
  bool can_be_sampled_ = false;
};

}  // namespace lemma
