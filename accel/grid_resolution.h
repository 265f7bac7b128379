#pragma once

#include <array>
#include <span>

#include "accel/accelerator.h"
#include "src/core/triangle.h"

namespace lemma {

/// Numbers of cells an axis so that cells are about cubes and about `target` in all. An axis too short for
/// one cell gets one, and the others share its part: flat and needle-shaped boxes need no case of their own.
/// Source: Cleary, Wyvill, Analysis of an Algorithm for Fast Ray Tracing Using Uniform Space Subdivision,
/// 1988.
[[nodiscard]] std::array<int, 3> cell_counts(const Vec3d& extent, double target);

/// How many cells the scene's level should have.
/// @param extent  of the triangles' bounds
[[nodiscard]] double target_cells(const GridResolution& resolution, std::span<const Triangle> triangles,
                                  const Vec3d& extent);

}  // namespace lemma
