#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/accelerator.h"
#include "src/core/triangle.h"

namespace lemma {

/// 4 x 4 x 4 cells of a grid: which of them are occupied, and how far the next brick is that has any.
struct Brick {
  std::uint64_t occupied = 0;    // bit x + 4 y + 16 z of the cell's place in the brick
  std::uint32_t first_list = 0;  // of its first occupied cell; the others follow in the order of their bits
  std::uint32_t clearance = 0;   // every brick less than this many bricks away, diagonals too, is empty
};
static_assert(sizeof(Brick) == 16);

/// A box cut into equal cells, each with the list of the triangles that it may contain a part of.
///
/// Cells are stored in bricks, so that an empty cell costs a bit, and bricks know their clearance, so that a
/// walk leaps over empty space. Source: Cohen, Sheffer, Proximity Clouds: an Acceleration Technique for 3D
/// Grid Traversal, The Visual Computer 11(1), 1994. A cell crowded with triangles small against it holds a
/// grid of its own in place of a list. Source: Kalojanov, Billeter, Slusallek, Two-Level Grids for Ray
/// Tracing on GPUs, Computer Graphics Forum 30(2), 2011.
///
/// Every triangle within margin() of a cell is in its list, so a walk that rounding leads into the neighbour
/// of the right cell still meets every triangle it should.
struct GridCells {
  static constexpr int kBrick = 4;  // cells a brick and axis

  Vec3d lo{0}, hi{0};                  // of the box; nothing lies on its boundary
  std::array<int, 3> counts{1, 1, 1};  // cells an axis
  std::array<int, 3> bricks_per_axis{1, 1, 1};
  Vec3d cell_size{0}, cells_per_unit{0};  // size of a cell [scene units], and its reciprocal
  Vec3d margin{0};  // by which a cell is widened on each side when triangles are sorted in

  std::vector<Brick> bricks;
  std::vector<std::uint32_t> first;       // where each list begins in `references`; one more at the end
  std::vector<std::uint32_t> references;  // triangle indices, ascending within a list
  std::vector<float> vertices;            // of the references, list by list: see packed()
  std::vector<GridCells> children;        // grids of the crowded cells, whose own lists are empty
  std::vector<std::uint32_t> crowded;     // number of the list that each child stands for, ascending

  /// The brick with the given place in the grid.
  [[nodiscard]] std::size_t brick_index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(bricks_per_axis[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(bricks_per_axis[0]) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::size_t list_count() const { return first.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> list(std::size_t i) const {
    return {references.data() + first[i], references.data() + first[i + 1]};
  }
  /// The vertices of list i as nine arrays of its length, v0.x v0.y v0.z v1.x ... v2.z. Reading up to
  /// kOverread floats past the last array is safe.
  [[nodiscard]] const float* packed(std::size_t i) const { return vertices.data() + 9ull * first[i]; }
  static constexpr std::size_t kOverread = 16;

  /// The grid in the crowded cell whose list is i, which is empty.
  [[nodiscard]] const GridCells& child(std::size_t i) const;

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
