#include "accel/grid_cells.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "accel/grid_overlap.h"
#include "src/core/bounds.h"
#include "src/core/error_bound.h"
#include "src/core/parallel.h"

namespace lemma {
namespace {

constexpr double kDensity = 2;          // cells a triangle
constexpr double kMaxCells = 1u << 28;  // 3 GiB of list heads and clearances

constexpr std::size_t kCrowd = 200;  // triangles of a cell that are worth a grid of their own
constexpr double kChildDensity = 2;  // its cells a triangle
constexpr double kMaxCopies = 8;     // its references a triangle; more: they do not come apart
constexpr int kMaxDepth = 3;         // grids within grids

constexpr std::size_t kChunk = 4096;  // triangles that one task sorts in

/// A cell is widened by this part of its size, for the rounding of the walk: up to 2^-10 of a cell
/// (GridWalk).
constexpr double kCellMargin = 1.0 / 256;

/// And by this part of the scene's size, for the rounding of hits: a hit lies within kPlaneError * kRoundoff
/// * M of its triangle (src/core/error_bound.h), where M is at most 8 scene sizes for rays that start within
/// seven of the scene.
constexpr double kReachMargin = 8 * kPlaneError * kRoundoff;

/// Some of the triangles of a scene, and the box that a grid of them covers.
struct Content {
  std::span<const Triangle> triangles;
  std::span<const std::uint32_t> selected;  // indices of triangles, ascending
  Vec3d lo, hi;
  double reach;  // largest coordinate difference in the scene
};

double target_cells(const GridResolution& resolution, std::size_t triangles) {
  if (resolution.cells > 0) return static_cast<double>(resolution.cells);
  const double density = resolution.rule == GridResolution::Rule::twenty_seven ? 27 : kDensity;
  return density * static_cast<double>(std::max<std::size_t>(triangles, 1));
}

/// A grid over the content's box, without cells yet.
GridCells lay_out(const Content& content, double target) {
  GridCells grid;
  grid.lo = content.lo;
  grid.hi = content.hi;
  const Vec3d extent = grid.hi - grid.lo;
  grid.counts = cell_counts(extent, std::min(target, kMaxCells));
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    grid.cell_size[k] = extent[k] / grid.counts[axis];
    grid.cells_per_unit[k] = 1 / grid.cell_size[k];
    grid.margin[k] = grid.cell_size[k] * kCellMargin + kReachMargin * content.reach;
  }
  return grid;
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
    const auto cell = [&](double x) {
      const double position = (x - grid.lo[k]) * grid.cells_per_unit[k];
      return static_cast<int>(std::clamp(std::floor(position), 0.0, grid.counts[axis] - 1.0));
    };
    range.first[axis] = cell(box.lo[k] - grid.margin[k]);
    range.last[axis] = cell(box.hi[k] + grid.margin[k]);
  }
  return range;
}

/// Calls visit(index) for every cell that the triangle overlaps.
template <class Visit>
void for_each_overlapped_cell(const GridCells& grid, const Triangle& triangle, const Visit& visit) {
  const CellRange range = touched_cells(grid, triangle);
  if (range.first == range.last) return visit(grid.index(range.first));
  const BoxOverlap overlap(triangle, grid.cell_size * 0.5 + grid.margin);
  std::array<int, 3> cell{};
  for (cell[2] = range.first[2]; cell[2] <= range.last[2]; ++cell[2]) {
    for (cell[1] = range.first[1]; cell[1] <= range.last[1]; ++cell[1]) {
      for (cell[0] = range.first[0]; cell[0] <= range.last[0]; ++cell[0]) {
        const Vec3d centre = grid.lo + Vec3d(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5) * grid.cell_size;
        if (overlap.with_box_at(centre)) visit(grid.index(cell));
      }
    }
  }
}

struct Reference {
  std::uint32_t cell, triangle;
};

/// The references of all triangles, in chunks of consecutive triangles.
std::vector<std::vector<Reference>> find_references(const Content& content, const GridCells& grid) {
  std::vector<std::vector<Reference>> chunks((content.selected.size() + kChunk - 1) / kChunk);
  parallel_for(chunks.size(), [&](std::size_t c) {
    const std::size_t end = std::min((c + 1) * kChunk, content.selected.size());
    for (std::size_t i = c * kChunk; i < end; ++i) {
      const std::uint32_t triangle = content.selected[i];
      for_each_overlapped_cell(grid, content.triangles[triangle], [&](std::size_t cell) {
        chunks[c].push_back({static_cast<std::uint32_t>(cell), triangle});
      });
    }
  });
  return chunks;
}

/// Calls body(i) for each i in [0, count) on several threads, kChunk of them at a time.
template <class Body>
void parallel_chunks(std::size_t count, const Body& body) {
  parallel_for((count + kChunk - 1) / kChunk, [&](std::size_t c) {
    const std::size_t end = std::min((c + 1) * kChunk, count);
    for (std::size_t i = c * kChunk; i < end; ++i) body(i);
  });
}

/// Sorts the references by cell, then by triangle. Threads place a list's entries in any order; sorting it
/// makes the result the same for any number of them.
void sort_into_lists(const std::vector<std::vector<Reference>>& chunks, GridCells& grid) {
  const std::size_t cells = grid.index({grid.counts[0] - 1, grid.counts[1] - 1, grid.counts[2] - 1}) + 1;
  grid.first.assign(cells + 1, 0);
  const auto claim = [](std::uint32_t& x) {
    return std::atomic_ref(x).fetch_add(1, std::memory_order_relaxed);
  };
  parallel_for(chunks.size(), [&](std::size_t c) {
    for (const Reference& r : chunks[c]) claim(grid.first[r.cell + 1]);
  });
  std::partial_sum(grid.first.begin(), grid.first.end(), grid.first.begin());
  grid.references.resize(grid.first.back());
  std::vector<std::uint32_t> next = grid.first;
  parallel_for(chunks.size(), [&](std::size_t c) {
    for (const Reference& r : chunks[c]) grid.references[claim(next[r.cell])] = r.triangle;
  });
  parallel_chunks(cells, [&](std::size_t i) {
    std::sort(grid.references.begin() + grid.first[i], grid.references.begin() + grid.first[i + 1]);
  });
}

/// A cell's clearance in one octant is 1 more than the least of its seven neighbours' there; beyond the grid
/// all is clear.
void find_clearances(GridCells& grid, unsigned octant) {
  const int nx = grid.counts[0], ny = grid.counts[1], nz = grid.counts[2];
  std::uint8_t* clearance = grid.clearance.data() + octant * grid.cell_count();
  const auto width = static_cast<std::size_t>(nx);
  const std::vector<std::uint8_t> clear(width, 255);
  std::vector<std::uint8_t> beside(width);  // least of a column's three neighbours in other rows
  const bool up_x = (octant & 1) != 0, up_y = (octant & 2) != 0, up_z = (octant & 4) != 0;
  const auto row = [&](int y, int z) -> std::uint8_t* { return clearance + grid.index({0, y, z}); };
  const auto neighbour_row = [&](int y, int z) -> const std::uint8_t* {
    return y < 0 || z < 0 || y >= ny || z >= nz ? clear.data() : row(y, z);
  };
  for (int k = 0; k < nz; ++k) {
    const int z = up_z ? nz - 1 - k : k, next_z = up_z ? z + 1 : z - 1;
    for (int j = 0; j < ny; ++j) {
      const int y = up_y ? ny - 1 - j : j, next_y = up_y ? y + 1 : y - 1;
      const std::uint8_t* a = neighbour_row(next_y, z);
      const std::uint8_t* b = neighbour_row(y, next_z);
      const std::uint8_t* c = neighbour_row(next_y, next_z);
      for (std::size_t x = 0; x < width; ++x) beside[x] = std::min(std::min(a[x], b[x]), c[x]);
      std::uint8_t* own = row(y, z);
      std::uint8_t last = 255, last_beside = 255;
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t x = up_x ? width - 1 - i : i;
        const std::uint8_t least =
            std::min(std::min(last, last_beside), std::min(beside[x], std::uint8_t{254}));
        last = own[x] == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(least + 1);
        last_beside = beside[x];
        own[x] = last;
      }
    }
  }
}

/// To be called while the crowded cells still have their lists.
void find_clearances(GridCells& grid) {
  const std::size_t cells = grid.cell_count();
  grid.clearance.resize(8 * cells);
  parallel_for(8, [&](std::size_t octant) {
    std::uint8_t* clearance = grid.clearance.data() + octant * cells;
    for (std::size_t i = 0; i < cells; ++i) clearance[i] = grid.list(i).empty() ? 255 : 0;
    find_clearances(grid, static_cast<unsigned>(octant));
  });
}

void pack_vertices(std::span<const Triangle> triangles, GridCells& grid) {
  grid.vertices.resize(9 * grid.references.size() + GridCells::kOverread);
  parallel_chunks(grid.cell_count(), [&](std::size_t i) {
    const auto list = grid.list(i);
    float* out = grid.vertices.data() + 9ull * grid.first[i];
    for (std::size_t j = 0; j < list.size(); ++j) {
      const Triangle& t = triangles[list[j]];
      const std::array<float, 9> coordinates{t.v0.x, t.v0.y, t.v0.z, t.v1.x, t.v1.y,
                                             t.v1.z, t.v2.x, t.v2.y, t.v2.z};
      for (std::size_t a = 0; a < 9; ++a) out[a * list.size() + j] = coordinates[a];
    }
  });
}

/// Takes the lists that children stand for out of the references.
void empty_lists(GridCells& grid) {
  std::vector<std::uint32_t> references, first;
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < grid.cell_count(); ++i) {
    first.push_back(static_cast<std::uint32_t>(references.size()));
    if (next < grid.crowded.size() && grid.crowded[next] == i) {
      ++next;
      continue;
    }
    references.insert(references.end(), grid.list(i).begin(), grid.list(i).end());
  }
  first.push_back(static_cast<std::uint32_t>(references.size()));
  grid.references = std::move(references);
  grid.first = std::move(first);
}

GridCells build(const Content& content, double target, int depth);

/// A grid for a crowded list, if that takes its triangles apart.
/// @param lo, hi  the cell, margin included
std::optional<GridCells> split_crowd(const Content& parent, std::span<const std::uint32_t> list, Vec3d lo,
                                     Vec3d hi, int depth) {
  Bounds bounds;
  for (const std::uint32_t i : list) bounds.add(parent.triangles[i]);
  const double pad = kReachMargin * parent.reach;
  for (int k = 0; k < 3; ++k) {
    lo[k] = std::max(lo[k], bounds.lo[k] - pad);
    hi[k] = std::min(hi[k], bounds.hi[k] + pad);
  }
  const auto size = static_cast<double>(list.size());
  GridCells child = build({parent.triangles, list, lo, hi, parent.reach}, kChildDensity * size, depth + 1);
  if (static_cast<double>(child.reference_count()) > kMaxCopies * size) return std::nullopt;
  return child;
}

/// The lower corner of the cell with this index.
Vec3d cell_corner(const GridCells& grid, std::size_t index) {
  const auto nx = static_cast<std::size_t>(grid.counts[0]), ny = static_cast<std::size_t>(grid.counts[1]);
  const Vec3d place(static_cast<double>(index % nx), static_cast<double>(index / nx % ny),
                    static_cast<double>(index / nx / ny));
  return grid.lo + place * grid.cell_size;
}

/// Replaces crowded lists by grids.
void split_crowds(const Content& content, GridCells& grid, int depth) {
  if (depth >= kMaxDepth) return;
  std::vector<std::uint32_t> crowded;
  for (std::uint32_t i = 0; i < grid.cell_count(); ++i) {
    if (grid.list(i).size() > kCrowd && grid.list(i).size() < content.selected.size()) crowded.push_back(i);
  }
  if (crowded.empty()) return;
  std::vector<std::optional<GridCells>> children(crowded.size());
  parallel_for(crowded.size(), [&](std::size_t i) {
    const Vec3d lo = cell_corner(grid, crowded[i]);
    children[i] = split_crowd(content, grid.list(crowded[i]), lo - grid.margin,
                              lo + grid.cell_size + grid.margin, depth);
  });
  for (std::size_t i = 0; i < crowded.size(); ++i) {
    if (!children[i]) continue;
    grid.crowded.push_back(crowded[i]);
    grid.children.push_back(std::move(*children[i]));
  }
  empty_lists(grid);
}

GridCells build(const Content& content, double target, int depth) {
  GridCells grid = lay_out(content, target);
  sort_into_lists(find_references(content, grid), grid);
  find_clearances(grid);
  split_crowds(content, grid, depth);
  pack_vertices(content.triangles, grid);
  return grid;
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
      counts[axis] = static_cast<int>(
          std::clamp(std::round(extent[k] * per_unit), 1.0, double{GridCells::kMaxCellsPerAxis}));
  }
  return counts;
}

const GridCells& GridCells::child(std::size_t i) const {
  const auto place = std::lower_bound(crowded.begin(), crowded.end(), i);
  return children[static_cast<std::size_t>(place - crowded.begin())];
}

std::size_t GridCells::memory_bytes() const {
  std::size_t bytes = clearance.capacity() + vertices.capacity() * sizeof(float) +
                      (first.capacity() + references.capacity() + crowded.capacity()) * sizeof(std::uint32_t);
  for (const GridCells& child : children) bytes += sizeof(GridCells) + child.memory_bytes();
  return bytes;
}

std::size_t GridCells::reference_count() const {
  return std::accumulate(
      children.begin(), children.end(), references.size(),
      [](std::size_t sum, const GridCells& child) { return sum + child.reference_count(); });
}

GridCells build_grid_cells(std::span<const Triangle> triangles, const GridResolution& resolution) {
  if (triangles.empty()) {
    GridCells grid;
    grid.first = {0};
    return grid;
  }
  const Bounds bounds = bounds_of(triangles);
  const Vec3d lo(bounds.lo), hi(bounds.hi);
  const double reach = max_norm(hi - lo);
  // Widened by some roundings, so that no triangle lies on the boundary.
  const double pad = 16 * kRoundoff * (reach + std::max(max_norm(lo), max_norm(hi)));
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return build({triangles, all, lo - Vec3d(pad), hi + Vec3d(pad), reach},
               target_cells(resolution, triangles.size()), 0);
}

}  // namespace lemma
