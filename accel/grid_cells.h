#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/accelerator.h"
#include "src/core/triangle.h"

namespace lemma {

/// A box cut into equal cells, each with the list of the triangles that it may contain a part of.
/// Every triangle within kCellMargin of a cell is in its list, so a walk that rounding leads into the
/// neighbour of the right cell still meets every triangle it should.
struct GridCells {
  /// Part of a cell's size by which it is widened when triangles are sorted in. The walk, in double and
  /// recomputed from cell indices, errs by less than 2^-40 of the box; hits by kPlaneError
  /// (src/core/error_bound.h).
  static constexpr double kCellMargin = 1.0 / 256;

  Vec3d lo, hi;                        // of the box; nothing lies on its boundary
  std::array<int, 3> counts{1, 1, 1};  // cells an axis
  Vec3d cell_size, cells_per_unit;     // size of a cell [scene units], and its reciprocal
  std::vector<std::uint32_t>
      first;  // for each cell where its list begins in `references`; one more at the end
  std::vector<std::uint32_t> references;  // triangle indices, ascending within a cell

  [[nodiscard]] std::size_t index(const std::array<int, 3>& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(counts[1]) +
            static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(counts[0]) +
           static_cast<std::size_t>(cell[0]);
  }
  [[nodiscard]] std::span<const std::uint32_t> list(std::size_t cell) const {
    return {references.data() + first[cell], references.data() + first[cell + 1]};
  }
};

/// Numbers of cells an axis so that cells are about cubes and about `target` in all. An axis too short for
/// one cell gets one, and the others share its part: flat and needle-shaped boxes need no case of their own.
/// Source: Cleary, Wyvill, Analysis of an Algorithm for Fast Ray Tracing Using Uniform Space Subdivision,
/// 1988.
[[nodiscard]] std::array<int, 3> cell_counts(const Vec3d& extent, double target);

/// Sorts the triangles into cells.
[[nodiscard]] GridCells build_grid_cells(std::span<const Triangle> triangles,
                                         const GridResolution& resolution);

}  // namespace lemma
