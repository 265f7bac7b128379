#pragma once

#include <vector>

#include "src/core/sampler.h"
#include "src/core/triangle.h"

namespace lemma::test {

/// Closed latitude-longitude sphere: poles at the ends of the y axis, outward winding; 2 segments (rings - 1)
/// triangles.
[[nodiscard]] std::vector<Triangle> sphere_mesh(const Vec3& centre, float radius, int rings, int segments);

/// `count` triangles of about the given size, at random in the unit cube.
[[nodiscard]] std::vector<Triangle> random_triangles(std::size_t count, float size, std::uint64_t seed);

/// The six faces of a box, two triangles each, wound so that normals point inward.
[[nodiscard]] std::vector<Triangle> inward_box(const Vec3& lo, const Vec3& hi);

/// Uniform over the unit sphere.
[[nodiscard]] Vec3 random_direction(Sampler& random);

/// Uniform in the unit cube.
[[nodiscard]] Vec3 random_point(Sampler& random);

}  // namespace lemma::test
