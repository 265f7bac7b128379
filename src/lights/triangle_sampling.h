#pragma once

#include "src/lights/connection.h"
#include "src/lights/spherical_triangle.h"

namespace lemma {

/// Where the direction w from x meets the triangle, moved onto it where rounding led past its edge.
[[nodiscard]] Vec3d point_seen(const Triangle& triangle, const Vec3& x, const Vec3d& w);

/// The point of a triangle uniform by area.
/// @param u  uniform in [0,1)^2
[[nodiscard]] Vec3d sample_area(const Triangle& triangle, const Vec2& u);

/// The density of sample_area, times the probability `pmf` of the triangle.
[[nodiscard]] PdfSolidAngle area_pdf(double pmf, const Triangle& triangle, const Connection& connection);

/// The point of an emitter that a direction uniform over the triangle's solid angle as `seen` from x leads
/// to; a triangle too small on the sphere for that is sampled uniformly by area.
/// @param u  uniform in [0,1)^2
[[nodiscard]] Vec3d sample_triangle(const Triangle& triangle, const SphericalTriangle& seen, const Vec3& x,
                                    const Vec2& u);

/// The density of sample_triangle, times the probability `pmf` of the triangle.
[[nodiscard]] PdfSolidAngle triangle_pdf(double pmf, const Triangle& triangle, const SphericalTriangle& seen,
                                         const Connection& connection);

}  // namespace lemma
