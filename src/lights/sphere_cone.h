#pragma once

#include <numbers>

#include "src/core/vec.h"
#include "src/core/warp.h"
#include "src/lights/tangent.h"

namespace lemma {

/// The cone of directions from x that meet a sphere, in double. All it says means nothing unless it can be
/// sampled.
class SphereCone {
 public:
  [[gnu::always_inline]] SphereCone(const Vec3d& centre, double radius, const Vec3& x) {
    const Vec3d to_centre = centre - Vec3d(x);
    const double distance2 = dot(to_centre, to_centre);
    can_be_sampled_ = can_be_sampled(radius, distance2);
    const double sin2 = radius * radius / distance2;
    axis_ = to_centre * (1 / std::sqrt(distance2));
    one_minus_cos_ = sin2 / (1 + std::sqrt(1 - sin2));
  }

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
  [[nodiscard]] double solid_angle() const { return 2 * std::numbers::pi * one_minus_cos_; }

  /// Whether a unit direction lies within.
  [[gnu::always_inline, nodiscard]] bool holds(const Vec3d& w) const {
    const Vec3d apart = w - axis_;
    return 0.5 * dot(apart, apart) <= one_minus_cos_;
  }

  /// Unit direction, uniform over the cone, for u uniform in [0,1)^2.
  [[gnu::always_inline, nodiscard]] Vec3d sample(const Vec2& u) const {
    const double below_axis = u.x * one_minus_cos_;  // 1 - cos of the angle to the axis
    const double sine = std::sqrt(below_axis * (2 - below_axis));
    const auto [sin_phi, cos_phi] = sin_cos_turn(double{u.y});
    const Vec3d s = tangent(axis_), t = cross(axis_, s);
    return axis_ * (1 - below_axis) + (s * cos_phi + t * sin_phi) * sine;
  }

  /// The squared sine of the largest half angle that can be sampled.
  static constexpr float kLargestSin2 = 0.98f;

 private:
  static bool can_be_sampled(double radius, double distance2) {
    return radius * radius < kLargestSin2 * distance2;
  }

  Vec3d axis_;
  double one_minus_cos_;  // of the half angle: 1 - cos = sin^2 / (1 + cos), which does not cancel
  bool can_be_sampled_;
};

}  // namespace lemma
