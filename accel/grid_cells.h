#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/accelerator.h"
#include "src/core/triangle.h"

namespace lemma {

/// A box cut into equal cells, each with the list of the triangles that it may contain a part of.
///
/// Each empty cell knows its clearance, so that a walk leaps over empty space. Source: Cohen, Sheffer,
/// Proximity Clouds: an Acceleration Technique for 3D Grid Traversal, The Visual Computer 11(1), 1994; here
/// one for each octant of directions, since most rays start beside what they will not meet. A cell crowded
/// with triangles small against it holds a grid of its own in place of a list. Source: Kalojanov, Billeter,
/// Slusallek, Two-Level Grids for Ray Tracing on GPUs, Computer Graphics Forum 30(2), 2011.
///
/// Every triangle within `margin` of a cell is in its list, so a walk that rounding leads into the neighbour
/// of the right cell still meets every triangle it should.
struct GridCells {
  /// So many roundings are still small against the margin (GridWalk).
  static constexpr int kMaxCellsPerAxis = 4096;

  Vec3d lo{0}, hi{0};                     // of the box; nothing lies on its boundary
  std::array<int, 3> counts{1, 1, 1};     // cells an axis
  Vec3d cell_size{0}, cells_per_unit{0};  // size of a cell [scene units], and its reciprocal
  Vec3d margin{0};                        // a cell is widened by it on each side when triangles are sorted in

  std::vector<std::uint8_t> clearance;  // of all cells for each octant: see clearances()
  std::vector<std::uint32_t> first;     // where each cell's list begins in `references`; one more at the end
  std::vector<std::uint32_t> references;  // triangle indices, ascending within a list
  std::vector<float> vertices;            // of the references, list by list: see packed()
  std::vector<GridCells> children;        // grids of the crowded cells, whose own lists are empty
  std::vector<std::uint32_t> crowded;     // index of the cell of each child, ascending

  [[nodiscard]] std::size_t cell_count() const { return first.size() - 1; }
  [[nodiscard]] std::size_t index(const std::array<int, 3>& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(counts[1]) +
            static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(counts[0]) +
           static_cast<std::size_t>(cell[0]);
  }
  [[nodiscard]] std::span<const std::uint32_t> list(std::size_t cell) const {
    return {references.data() + first[cell], references.data() + first[cell + 1]};
  }

  /// For each cell the size of the largest cube of empty cells of which it is a corner and which extends up
  /// axis k if bit k of the octant is set, else down; 0 if the cell is occupied. nullptr if there are no
  /// cells.
  [[nodiscard]] const std::uint8_t* clearances(unsigned octant) const {
    return clearance.empty() ? nullptr : clearance.data() + octant * cell_count();
  }

  /// The vertices of a cell's list as nine arrays of its length, v0.x v0.y v0.z v1.x ... v2.z. Reading up to
  /// kOverread floats past the last array is safe.
  [[nodiscard]] const float* packed(std::size_t cell) const { return vertices.data() + 9ull * first[cell]; }
  static constexpr std::size_t kOverread = 8;

  /// The grid of a crowded cell: an occupied one whose list is empty.
  [[nodiscard]] const GridCells& child(std::size_t cell) const;

  [[nodiscard]] std::size_t memory_bytes() const;
  [[nodiscard]] std::size_t reference_count() const;  // children included
};

/// Numbers of cells an axis so that cells are about cubes and about `target` in all. An axis too short for
/// one cell gets one, and the others share its part: flat and needle-shaped boxes need no case of their own.
/// Source: Cleary, Wyvill, Analysis of an Algorithm for Fast Ray Tracing Using Uniform Space Subdivision,
/// 1988.
[[nodiscard]] std::array<int, 3> cell_counts(const Vec3d& extent, double target);

/// Sorts the triangles into cells, on several threads; the result does not depend on how many.
[[nodiscard]] GridCells build_grid_cells(std::span<const Triangle> triangles,
                                         const GridResolution& resolution);

}  // namespace lemma
