#include "src/lights/light_bounds.h"

#include <cmath>
#include <numbers>

namespace lemma {
namespace {

constexpr double kPi = std::numbers::pi;

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// The smallest cone around two: Conty and Kulla 2018, algorithm 1.
void unite_cones(const LightBounds& a, const LightBounds& b, LightBounds& both) {
  const LightBounds& wide = a.spread >= b.spread ? a : b;
  const LightBounds& narrow = a.spread >= b.spread ? b : a;
  const double apart = angle_between(wide.axis, narrow.axis);
  both.axis = wide.axis;
  both.spread = wide.spread;
  if (apart + narrow.spread <= wide.spread) return;
  both.spread = 0.5 * (wide.spread + apart + narrow.spread);
  const Vec3d side = narrow.axis - wide.axis * dot(wide.axis, narrow.axis);
  if (both.spread >= kPi || length(side) == 0) {
    both.spread = kPi;
    return;
  }
  const double turn = both.spread - wide.spread;
  both.axis = normalize(wide.axis * std::cos(turn) + normalize(side) * std::sin(turn));
}

// Cosines of angles near 0 and their sines by sqrt(1 - cos^2) err by up to 2^-11 in float32. Bounds that are
// this little below 0 count as 0 and no bound is below it, so that rounding never hides an emitter.
constexpr float kSlack = 1e-3f;

float sine(float cosine) {
  return std::sqrt(std::max(0.0f, 1 - cosine * cosine));
}

/// An angle in [0, pi].
struct Angle {
  float cosine, sine;
};

/// max(0, a - b).
Angle difference(const Angle& a, const Angle& b) {
  if (a.cosine >= b.cosine) return {1, 0};
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

/// max(0, cosine), but for the slack.
float above_horizon(const Angle& a) {
  return a.cosine < -kSlack ? 0.0f : std::max(a.cosine, kSlack);
}

/// Squared radius of the sphere about a point that holds the box, rounded up.
float radius2_around(const Vec3& centre, const Bounds& box) {
  Vec3d reach;
  for (int k = 0; k < 3; ++k) {
    reach[k] = std::max(double{box.hi[k]} - double{centre[k]}, double{centre[k]} - double{box.lo[k]});
  }
  return static_cast<float>(dot(reach, reach) * (1 + 1e-6));
}

}  // namespace

LightBounds::LightBounds(const Emitter& emitter)
    : axis(normalize(area_vector(emitter.shape))),
      power(double{luminance(emitter.radiance)} * area(emitter.shape)) {
  box.add(emitter.shape);
}

LightBounds::LightBounds(const LightBounds& a, const LightBounds& b) : box(a.box), power(a.power + b.power) {
  box.add(b.box.lo);
  box.add(b.box.hi);
  unite_cones(a, b, *this);
}

LightImportance::LightImportance(const LightBounds& bounds)
    : centre_((bounds.box.lo + bounds.box.hi) * 0.5f),
      axis_(bounds.axis),
      radius2_(radius2_around(centre_, bounds.box)),
      cos_spread_(static_cast<float>(std::cos(bounds.spread))),
      sin_spread_(static_cast<float>(std::sin(bounds.spread))),
      power_(static_cast<float>(bounds.power)) {}

double LightImportance::operator()(const Vec3& x, const Vec3& n) const {
  const Vec3 to_centre = centre_ - x;
  const float distance2 = dot(to_centre, to_centre);
  const double near = double{power_} / std::max(distance2, radius2_);
  if (distance2 <= radius2_) return near;  // emitters may lie in any direction
  const Vec3 w = to_centre * (1 / std::sqrt(distance2));
  const Angle around{std::sqrt(1 - radius2_ / distance2), std::sqrt(radius2_ / distance2)};
  const float cos_emitter = -dot(axis_, w), cos_surface = dot(n, w);
  // The least angle that an emitter's normal makes with the direction from it to x, and the surface's with
  // that to an emitter.
  const Angle emitter =
      difference(difference({cos_emitter, sine(cos_emitter)}, {cos_spread_, sin_spread_}), around);
  const Angle surface = difference({cos_surface, sine(cos_surface)}, around);
  return near * above_horizon(emitter) * above_horizon(surface);
}

}  // namespace lemma
