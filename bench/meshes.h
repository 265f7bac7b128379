#pragma once

#include <vector>

#include "src/core/triangle.h"

// Scenes of any size without files: the same bits on every machine up to the rounding of sine and cosine.
namespace lemma::bench {

/// A sphere of radius 1 with ripples of two sizes, of at least `count` triangles, in the box from (-2, -2,
/// -2) to (2, 2, 2).
[[nodiscard]] std::vector<Triangle> displaced_sphere_in_box(std::size_t count);

/// Hills over the square from (-1, 0, -1) to (1, 0, 1), of at least `count` triangles; nothing else.
[[nodiscard]] std::vector<Triangle> height_field(std::size_t count);

/// A hall of 12 x 5 x 8 with columns along its walls, tables, and a vase on each: 30 thousand triangles, some
/// as long as the hall and most as small as a finger.
[[nodiscard]] std::vector<Triangle> interior();

/// A square of two triangles, facing down: what shadow rays aim at.
[[nodiscard]] std::vector<Triangle> lamp(const Vec3& centre, float half_width);

}  // namespace lemma::bench
