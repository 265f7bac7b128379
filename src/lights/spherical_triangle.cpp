#include "src/lights/spherical_triangle.h"

namespace lemma {
namespace {

// Below this squared chord between the directions to two vertices (5e-5 rad) cosines and distances vary by
// less than 1e-4 over the triangle; and this near to a full hemisphere the map's own error exceeds 1e-9.
constexpr double kSmallestChord2 = 1e-8;
constexpr double kSmallestSolidAngle = 1e-11;
constexpr double kHemisphere = 2 * 3.14159265358979323846;
constexpr double kLargestSolidAngle = kHemisphere * (1 - 1e-5);

double chord2(const Vec3d& a, const Vec3d& b) {
  const Vec3d d = a - b;
  return dot(d, d);
}

}  // namespace

SphericalTriangle::SphericalTriangle(const Triangle& triangle, const Vec3& x) {
  const Vec3d origin(x);
  const Vec3d a = Vec3d(triangle.v0) - origin, b = Vec3d(triangle.v1) - origin,
              c = Vec3d(triangle.v2) - origin;
  const double la = length(a), lb = length(b), lc = length(c);
  if (la == 0 || lb == 0 || lc == 0) return;
  a_ = a * (1 / la), b_ = b * (1 / lb), c_ = c * (1 / lc);
  volume_ = std::abs(dot(a, area_vector(triangle))) / (la * lb * lc);
  if (volume_ == 0) return;
  solid_angle_ = 2 * std::atan2(volume_, 1 + dot(a_, b_) + dot(b_, c_) + dot(c_, a_));
  const double widest = std::max({chord2(a_, b_), chord2(b_, c_), chord2(c_, a_)});
  can_be_sampled_ =
      widest > kSmallestChord2 && solid_angle_ > kSmallestSolidAngle && solid_angle_ < kLargestSolidAngle;
}

Vec3d SphericalTriangle::sample(const Vec2& u) const {
  // b is the apex that the arcs run to. The arc through the point sought meets the side a c in d, where the
  // part of the triangle beside it covers u.x of its solid angle.
  const double p1 = dot(a_, c_) + dot(b_, c_);
  const double p2 = 1 + dot(a_, b_);
  const double half = 0.5 * u.x * solid_angle_;
  const double cos_half = std::cos(half), sin_half = std::sin(half);
  const Vec3d offset = a_ * (volume_ * cos_half - p1 * sin_half) + c_ * (p2 * sin_half);
  const Vec3d d = offset * (2 * dot(a_, offset) / dot(offset, offset)) - a_;
  // Along the arc from the apex (cosine 1) to d (cosine s2), heights are uniform.
  const double s2 = dot(b_, d);
  const double s = 1 + u.y * (s2 - 1);
  const double sin2_d = 1 - s2 * s2;
  const double ratio = sin2_d > 0 ? std::sqrt(std::max(0.0, (1 - s * s) / sin2_d)) : static_cast<double>(u.y);
  return normalize(b_ * (s - ratio * s2) + d * ratio);
}

}  // namespace lemma
