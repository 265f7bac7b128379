#include "src/lights/triangle_sampling.h"

#include "src/core/warp.h"

namespace lemma {

Vec3d point_seen(const Triangle& t, const Vec3& x, const Vec3d& w) {
  const Vec3d v0(t.v0), e1 = Vec3d(t.v1) - v0, e2 = Vec3d(t.v2) - v0, s = Vec3d(x) - v0;
  const Vec3d p = cross(w, e2), q = cross(s, e1);
  const double determinant = dot(e1, p);
  const double b1 = std::clamp(dot(s, p) / determinant, 0.0, 1.0);
  const double b2 = std::clamp(dot(w, q) / determinant, 0.0, 1.0 - b1);
  return point_at(t, b1, b2);
}

Vec3d sample_area(const Triangle& triangle, const Vec2& u) {
  const auto [b1, b2] = uniform_triangle(u);
  return point_at(triangle, b1, b2);
}

PdfSolidAngle area_pdf(double pmf, const Triangle& triangle, const Connection& connection) {
  return to_solid_angle({static_cast<float>(pmf / area(triangle))}, connection.distance2,
                        connection.cos_light);
}

Vec3d sample_triangle(const Triangle& triangle, const SphericalTriangle& seen, const Vec3& x, const Vec2& u) {
  if (seen.can_be_sampled()) return point_seen(triangle, x, seen.sample(u));
  return sample_area(triangle, u);
}

PdfSolidAngle triangle_pdf(double pmf, const Triangle& triangle, const SphericalTriangle& seen,
                           const Connection& connection) {
  if (seen.can_be_sampled()) return {static_cast<float>(pmf / seen.solid_angle())};
  return area_pdf(pmf, triangle, connection);
}

}  // namespace lemma
