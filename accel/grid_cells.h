#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/accelerator.h"
#include "src/core/large_vector.h"
#include "src/core/triangle.h"

namespace lemma {

/// A box cut into equal cells, of which the occupied ones have records. Two lines of the cache.
struct alignas(64) GridLevel {
  /// So many roundings are still small against the margin (GridCrossing).
  static constexpr int kMaxCellsPerAxis = 4096;

  Vec3d lo{0};                         // lower corner of the box; nothing lies on its boundary
  Vec3d cells_per_unit{0};             // cells an axis / size of the box [1 / scene units]
  std::array<int, 3> counts{1, 1, 1};  // cells an axis
  std::uint32_t words = 0;             // where its part of GridCells::occupied begins
  std::uint32_t near = 0;              // and that of GridCells::near

  [[nodiscard]] std::uint32_t index(const std::array<int, 3>& cell) const {
    return static_cast<std::uint32_t>((cell[2] * counts[1] + cell[1]) * counts[0] + cell[0]);
  }
  [[nodiscard]] std::uint32_t cell_count() const {
    return index({counts[0] - 1, counts[1] - 1, counts[2] - 1}) + 1;
  }
};

/// The scene in equal cells, each with the list of the triangles that it may contain a part of. A cell
/// crowded with triangles small against it holds a grid of its own in place of a list. Source: Kalojanov,
/// Billeter, Slusallek, Two-Level Grids for Ray Tracing on GPUs, Computer Graphics Forum 30(2), 2011.
///
/// Every triangle within a margin of a cell is in its list, so a walk that rounding leads into the neighbour
/// of the right cell still meets every triangle it should.
struct GridCells {
  /// 32 cells of a level: a bit for each that is occupied, and how many are in all words before.
  struct Word {
    std::uint32_t bits, before;
  };
  /// An occupied cell: a list of `count` references, or the grid levels[begin] if count is kLevel. The box
  /// holds the parts of its triangles that lie in the cell: rays that miss it need not look at the list.
  struct alignas(32) Record {
    static constexpr std::uint32_t kLevel = 0xFFFFFFFFu;
    Vec3 lo{0};
    std::uint32_t begin = 0;
    Vec3 hi{0};
    std::uint32_t count = 0;
  };

  std::vector<GridLevel> levels;  // the whole scene first; none if there are no triangles
  std::vector<Word> occupied;     // of the levels, one after the other
  /// Of each cell a byte, four in a word from the lowest on: bit x + 2 y + 4 z says whether the cell that
  /// many further on each axis, 0 or 1, is occupied. Rays look here for the cells they pass in a slice at
  /// once.
  std::vector<std::uint32_t> near;
  std::vector<Record> records;            // of the occupied cells, in their order
  std::vector<std::uint32_t> references;  // triangle indices, list by list
  LargeVector<float> vertices;            // of the references, see packed()
  /// Where rays may start: hits of those that start further away err by more than the cells' margin.
  Vec3 trusted_lo{0}, trusted_hi{0};
  Vec3d lo{0}, hi{0};  // the scene

  [[nodiscard]] bool is_occupied(const GridLevel& level, std::uint32_t cell) const {
    return (occupied[level.words + cell / 32].bits >> cell % 32 & 1) != 0;
  }
  /// @param cell  an occupied one
  [[nodiscard]] const Record& record(const GridLevel& level, std::uint32_t cell) const {
    return records[place(level, cell)];
  }
  [[nodiscard]] Record& record(const GridLevel& level, std::uint32_t cell) {
    return records[place(level, cell)];
  }

  /// A list is stored in parts of so many triangles and a last one of the rest.
  static constexpr std::size_t kPart = 16;
  /// Up to so many are all tested: boxes of their parts took longer.
  static constexpr std::size_t kFew = 48;
  static constexpr std::size_t part_count(std::size_t triangles) { return (triangles + kPart - 1) / kPart; }
  /// Parts are looked for in groups of so many where there are more.
  static constexpr std::size_t kGroup = 16;
  static constexpr std::size_t group_count(std::size_t triangles) {
    const std::size_t parts = part_count(triangles);
    return parts <= kGroup ? 0 : (parts + kGroup - 1) / kGroup;
  }
  /// Places of nine floats that a list's boxes take, in `vertices` before it; the same places in `references`
  /// hold 0.
  static constexpr std::size_t box_places(std::size_t triangles) {
    return triangles <= kFew ? 0 : (6 * (part_count(triangles) + group_count(triangles)) + 8) / 9;
  }

  /// The vertices of a part of n triangles that begins with the first of a list, or the kPart-th, and so on:
  /// nine arrays of length n, v0.x v0.y v0.z v1.x ... v2.z. Reading up to kOverread floats past the last
  /// array is safe, and as many indices past the last list.
  [[nodiscard]] const float* packed(std::size_t reference) const { return vertices.data() + 9 * reference; }
  static constexpr std::size_t kOverread = 16;

  /// Where a list has more than one part, their boxes: six arrays, lo.x lo.y lo.z hi.x hi.y hi.z.
  [[nodiscard]] const float* part_boxes(const Record& list) const {
    return vertices.data() + 9 * (list.begin - box_places(list.count));
  }
  [[nodiscard]] float* part_boxes(const Record& list) {
    return vertices.data() + 9 * (list.begin - box_places(list.count));
  }
  /// Where a list has groups, their boxes: six arrays again.
  [[nodiscard]] const float* group_boxes(const Record& list) const {
    return part_boxes(list) + 6 * part_count(list.count);
  }
  [[nodiscard]] float* group_boxes(const Record& list) {
    return part_boxes(list) + 6 * part_count(list.count);
  }

  /// Triangle i of a cell's list.
  [[nodiscard]] Triangle triangle(const Record& list, std::size_t i) const {
    const std::size_t part = i - i % kPart, n = std::min(kPart, list.count - part);
    const float* p = packed(list.begin + part) + i % kPart;
    return {{p[0], p[n], p[2 * n]}, {p[3 * n], p[4 * n], p[5 * n]}, {p[6 * n], p[7 * n], p[8 * n]}};
  }

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  /// Of an occupied cell's record.
  [[nodiscard]] std::size_t place(const GridLevel& level, std::uint32_t cell) const {
    const Word& word = occupied[level.words + cell / 32];
    const std::uint32_t below = word.bits & ((1u << cell % 32) - 1);
    return word.before + static_cast<std::uint32_t>(__builtin_popcount(below));
  }
};

/// Sorts the triangles into cells, on several threads; the result does not depend on how many.
[[nodiscard]] GridCells build_grid_cells(std::span<const Triangle> triangles,
                                         const GridResolution& resolution);

}  // namespace lemma
