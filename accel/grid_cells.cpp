#include "accel/grid_cells.h"

#include <algorithm>
#include <cmath>

#include "accel/grid_overlap.h"
#include "src/core/bounds.h"
#include "src/core/error_bound.h"

namespace lemma {
namespace {

constexpr double kDensity = 8;          // cells a triangle: within 10 % of the best from 3e3 to 1e6 triangles
constexpr double kMaxCells = 1u << 28;  // 1 GiB of list heads
constexpr double kMaxCellsPerAxis = 65535;  // the cell index stays exact, the margin above rounding

double target_cells(const GridResolution& resolution, std::size_t triangles) {
  if (resolution.cells > 0) return static_cast<double>(resolution.cells);
  const double density = resolution.rule == GridResolution::Rule::twenty_seven ? 27 : kDensity;
  return density * static_cast<double>(std::max<std::size_t>(triangles, 1));
}

/// The box of the cells: the scene's, widened by some roundings so that no triangle lies on its boundary.
void place_box(const Bounds& bounds, GridCells& grid) {
  const Vec3d lo(bounds.lo), hi(bounds.hi);
  const double pad = 16 * kRoundoff * (max_norm(hi - lo) + std::max(max_norm(lo), max_norm(hi)));
  grid.lo = lo - Vec3d(pad);
  grid.hi = hi + Vec3d(pad);
}

struct CellRange {
  std::array<int, 3> first, last;
};

/// The cells that the triangle's bounding box touches, margin included.
CellRange touched_cells(const GridCells& grid, const Triangle& triangle) {
  Bounds box;
  box.add(triangle);
  CellRange range{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const auto cell = [&](double x, double margin) {
      const double position = (x - grid.lo[k]) * grid.cells_per_unit[k] + margin;
      return static_cast<int>(std::clamp(std::floor(position), 0.0, grid.counts[axis] - 1.0));
    };
    range.first[axis] = cell(box.lo[k], -GridCells::kCellMargin);
    range.last[axis] = cell(box.hi[k], GridCells::kCellMargin);
  }
  return range;
}

/// Calls visit(cell) for every cell that the triangle overlaps.
template <class Visit>
void for_each_overlapped_cell(const GridCells& grid, const Triangle& triangle, const Visit& visit) {
  const CellRange range = touched_cells(grid, triangle);
  const BoxOverlap overlap(triangle, grid.cell_size * (0.5 + GridCells::kCellMargin));
  std::array<int, 3> cell{};
  for (cell[2] = range.first[2]; cell[2] <= range.last[2]; ++cell[2]) {
    for (cell[1] = range.first[1]; cell[1] <= range.last[1]; ++cell[1]) {
      for (cell[0] = range.first[0]; cell[0] <= range.last[0]; ++cell[0]) {
        const Vec3d position(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5);
        if (overlap.with_box_at(grid.lo + position * grid.cell_size)) visit(grid.index(cell));
      }
    }
  }
}

struct Reference {
  std::uint32_t cell, triangle;
};

/// Turns references in order of triangles into one list a cell, each still in order of triangles.
void sort_into_lists(std::span<const Reference> references, std::size_t cells, GridCells& grid) {
  grid.first.assign(cells + 1, 0);
  for (const Reference& r : references) ++grid.first[r.cell + 1];
  for (std::size_t c = 0; c < cells; ++c) grid.first[c + 1] += grid.first[c];
  std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
  grid.references.resize(references.size());
  for (const Reference& r : references) grid.references[next[r.cell]++] = r.triangle;
}

}  // namespace

std::array<int, 3> cell_counts(const Vec3d& extent, double target) {
  std::array<int, 3> counts{1, 1, 1};
  std::array<bool, 3> split{extent[0] > 0, extent[1] > 0, extent[2] > 0};
  double per_unit = 0;
  for (bool settled = false; !settled;) {
    double volume = 1;
    int dimensions = 0;
    for (int k = 0; k < 3; ++k) {
      if (split[static_cast<std::size_t>(k)]) volume *= extent[k], ++dimensions;
    }
    if (dimensions == 0) return counts;
    per_unit = std::pow(target / volume, 1.0 / dimensions);
    settled = true;
    for (int k = 0; k < 3; ++k) {
      auto&& splits = split[static_cast<std::size_t>(k)];
      if (splits && extent[k] * per_unit < 1 && dimensions > 1) splits = false, settled = false;
    }
  }
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (split[axis])
      counts[axis] = static_cast<int>(std::clamp(std::round(extent[k] * per_unit), 1.0, kMaxCellsPerAxis));
  }
  return counts;
}

GridCells build_grid_cells(std::span<const Triangle> triangles, const GridResolution& resolution) {
  GridCells grid;
  if (triangles.empty()) {
    grid.first = {0, 0};
    return grid;
  }
  place_box(bounds_of(triangles), grid);
  const Vec3d extent = grid.hi - grid.lo;
  grid.counts = cell_counts(extent, std::min(target_cells(resolution, triangles.size()), kMaxCells));
  for (int k = 0; k < 3; ++k) {
    grid.cell_size[k] = extent[k] / grid.counts[static_cast<std::size_t>(k)];
    grid.cells_per_unit[k] = 1 / grid.cell_size[k];
  }
  std::vector<Reference> references;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for_each_overlapped_cell(grid, triangles[i], [&](std::size_t cell) {
      references.push_back({static_cast<std::uint32_t>(cell), i});
    });
  }
  const std::size_t cells = grid.index({grid.counts[0] - 1, grid.counts[1] - 1, grid.counts[2] - 1}) + 1;
  sort_into_lists(references, cells, grid);
  return grid;
}

}  // namespace lemma
