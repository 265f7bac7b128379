#include "src/lights/sphere_cone.h"

#include <numbers>

#include "src/core/warp.h"
#include "src/lights/tangent.h"

namespace lemma {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

}  // namespace

SphereCone::SphereCone(const Vec3d& centre, double radius, const Vec3& x) {
  const Vec3d to_centre = centre - Vec3d(x);
  const double distance2 = dot(to_centre, to_centre);
  can_be_sampled_ = can_be_sampled(radius, distance2);
  if (!can_be_sampled_) return;
  const double sin2 = radius * radius / distance2;
  axis_ = to_centre * (1 / std::sqrt(distance2));
  one_minus_cos_ = sin2 / (1 + std::sqrt(1 - sin2));
}

double SphereCone::solid_angle() const {
  return kTwoPi * one_minus_cos_;
}

bool SphereCone::holds(const Vec3d& w) const {
  const Vec3d apart = w - axis_;
  return 0.5 * dot(apart, apart) <= one_minus_cos_;
}

Vec3d SphereCone::sample(const Vec2& u) const {
  const double below_axis = u.x * one_minus_cos_;  // 1 - cos of the angle to the axis
  const double sine = std::sqrt(below_axis * (2 - below_axis));
  const auto [sin_phi, cos_phi] = sin_cos_turn(double{u.y});
  const Vec3d s = tangent(axis_), t = cross(axis_, s);
  return axis_ * (1 - below_axis) + (s * cos_phi + t * sin_phi) * sine;
}

}  // namespace lemma
