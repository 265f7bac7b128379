#include "accel/grid_cells.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <utility>

#include "accel/grid_boxes.h"
#include "accel/grid_near.h"
#include "accel/grid_overlap.h"
#include "accel/grid_resolution.h"
#include "src/core/bounds.h"
#include "src/core/error_bound.h"
#include "src/core/parallel.h"

namespace lemma {
namespace {

constexpr double kMaxCells = 1u << 28;  // a cell's index fits an int

/// Triangles of a cell that are worth a grid of their own. Few cells hold so many: boxes of groups are as
/// fast up to there, with less memory and build time (8000 was slower with a sphere of 4 million triangles).
constexpr std::size_t kCrowd = 30000;
constexpr double kChildDensity = 0.5;  // its cells a triangle
constexpr double kMaxCopies = 8;       // its references a triangle; more: they do not come apart
constexpr int kMaxDepth = 3;           // grids within grids

constexpr std::size_t kChunk = 4096;  // triangles that one task sorts in

/// A cell is widened by this part of its size, for the rounding of the walk: up to 2^-10 of a cell
/// (GridCrossing).
constexpr double kCellMargin = 1.0 / 256;

/// And by this part of the scene's size, for the rounding of hits: a hit lies within kPlaneError * kRoundoff
/// * M of its triangle (src/core/error_bound.h), where M is at most kTrustedSizes scene sizes; rays from
/// further away are not walked (grid_far.h). 2^-15 of the scene: small against cells.
constexpr double kTrustedSizes = 64;
constexpr double kReachMargin = kTrustedSizes * kPlaneError * kRoundoff;

/// Boxes of smaller scenes could lose their margins to underflow: all rays are walked carefully.
constexpr double kSmallestScene = 0x1p-60;

/// Cells are at least so many of these margins thick: thinner ones would mostly list their neighbours'
/// triangles.
constexpr double kMarginsACell = 4;

/// Some of the triangles of a scene, and the box that a grid of them covers.
struct Content {
  std::span<const Triangle> triangles;
  std::span<const std::uint32_t> selected;  // indices of triangles, ascending
  Vec3d lo, hi;
  double reach;  // largest coordinate difference in the scene
};

/// A level while it is built: a list for every cell.
struct Part {
  GridLevel level;
  Vec3d cell_size{0};
  Vec3d margin{0};                   // a cell is widened by it on each side when triangles are sorted in
  std::vector<std::uint32_t> first;  // where each cell's list begins in `references`; one more at the end
  std::vector<std::uint32_t> references;  // triangle indices, ascending within a list
  std::vector<Part> children;             // grids of the crowded cells
  std::vector<std::uint32_t> crowded;     // index of the cell of each child, ascending

  [[nodiscard]] std::span<const std::uint32_t> list(std::size_t cell) const {
    return {references.data() + first[cell], references.data() + first[cell + 1]};
  }
};

/// A grid over the content's box, without cells yet.
Part lay_out(const Content& content, double target) {
  Part part;
  part.level.lo = content.lo;
  const Vec3d extent = content.hi - content.lo;
  part.level.counts = cell_counts(extent, std::min(target, kMaxCells));
  const double reach_margin = kReachMargin * content.reach;
  for (int k = 0; k < 3; ++k) {
    int& count = part.level.counts[static_cast<std::size_t>(k)];
    const double most = std::max(extent[k] / (kMarginsACell * reach_margin), 1.0);
    if (count > most) count = static_cast<int>(most);
    part.cell_size[k] = extent[k] / count;
    part.level.cells_per_unit[k] = 1 / part.cell_size[k];
    part.margin[k] = part.cell_size[k] * kCellMargin + reach_margin;
  }
  return part;
}

struct CellRange {
  std::array<int, 3> first, last;
};

/// The cells that the triangle's bounding box touches, margin included.
CellRange touched_cells(const Part& part, const Triangle& triangle) {
  Bounds box;
  box.add(triangle);
  CellRange range{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const auto cell = [&](double x) {
      const double position = (x - part.level.lo[k]) * part.level.cells_per_unit[k];
      return static_cast<int>(std::clamp(position, 0.0, part.level.counts[axis] - 1.0));
    };
    range.first[axis] = cell(box.lo[k] - part.margin[k]);
    range.last[axis] = cell(box.hi[k] + part.margin[k]);
  }
  return range;
}

/// Calls visit(index) for every cell that the triangle overlaps.
template <class Visit>
void for_each_overlapped_cell(const Part& part, const Triangle& triangle, const Visit& visit) {
  const CellRange range = touched_cells(part, triangle);
  if (range.first == range.last) return visit(part.level.index(range.first));
  const BoxOverlap overlap(triangle, part.cell_size * 0.5 + part.margin);
  std::array<int, 3> cell{};
  for (cell[2] = range.first[2]; cell[2] <= range.last[2]; ++cell[2]) {
    for (cell[1] = range.first[1]; cell[1] <= range.last[1]; ++cell[1]) {
      for (cell[0] = range.first[0]; cell[0] <= range.last[0]; ++cell[0]) {
        const Vec3d place = Vec3d(cell[0], cell[1], cell[2]) + Vec3d(0.5);
        if (overlap.with_box_at(part.level.lo + place * part.cell_size)) visit(part.level.index(cell));
      }
    }
  }
}

struct Reference {
  std::uint32_t cell, triangle;
};

/// Calls body(i) for each i in [0, count), on several threads if there are many.
template <class Body>
void for_each_chunk(std::size_t count, const Body& body) {
  if (count == 1) return body(0);
  parallel_for(count, body);
}

/// The references of all triangles, in chunks of consecutive triangles.
std::vector<std::vector<Reference>> find_references(const Content& content, const Part& part) {
  std::vector<std::vector<Reference>> chunks((content.selected.size() + kChunk - 1) / kChunk);
  for_each_chunk(chunks.size(), [&](std::size_t c) {
    const std::size_t end = std::min((c + 1) * kChunk, content.selected.size());
    chunks[c].reserve(4 * (end - c * kChunk));
    for (std::size_t i = c * kChunk; i < end; ++i) {
      const std::uint32_t triangle = content.selected[i];
      for_each_overlapped_cell(part, content.triangles[triangle], [&](std::uint32_t cell) {
        chunks[c].push_back({cell, triangle});
      });
    }
  });
  return chunks;
}

/// Calls body(i) for each i in [0, count) on several threads, kChunk of them at a time.
template <class Body>
void parallel_chunks(std::size_t count, const Body& body) {
  for_each_chunk((count + kChunk - 1) / kChunk, [&](std::size_t c) {
    const std::size_t end = std::min((c + 1) * kChunk, count);
    for (std::size_t i = c * kChunk; i < end; ++i) body(i);
  });
}

/// Sorts the references by cell, then by triangle. Threads place a list's entries in any order; sorting it
/// makes the result the same for any number of them.
void sort_into_lists(const std::vector<std::vector<Reference>>& chunks, Part& part) {
  const std::size_t cells = part.level.cell_count();
  part.first.assign(cells + 1, 0);
  const auto claim = [&](std::uint32_t& x) {
    if (chunks.size() == 1) return x++;  // one thread
    return std::atomic_ref(x).fetch_add(1, std::memory_order_relaxed);
  };
  for_each_chunk(chunks.size(), [&](std::size_t c) {
    for (const Reference& r : chunks[c]) claim(part.first[r.cell + 1]);
  });
  std::partial_sum(part.first.begin(), part.first.end(), part.first.begin());
  part.references.resize(part.first.back());
  std::vector<std::uint32_t> next = part.first;
  for_each_chunk(chunks.size(), [&](std::size_t c) {
    for (const Reference& r : chunks[c]) part.references[claim(next[r.cell])] = r.triangle;
  });
  if (chunks.size() == 1) return;  // and in the triangles' order
  parallel_chunks(cells, [&](std::size_t i) {
    std::sort(part.references.begin() + part.first[i], part.references.begin() + part.first[i + 1]);
  });
}

/// A grid of one level.
Part sort_in(const Content& content, double target) {
  Part part = lay_out(content, target);
  sort_into_lists(find_references(content, part), part);
  return part;
}

void split_crowds(const Content& content, Part& part, int depth);

/// A grid for a crowded list, if that takes its triangles apart.
/// @param lo, hi  the cell, margin included
std::optional<Part> split_crowd(const Content& parent, std::span<const std::uint32_t> list, Vec3d lo,
                                Vec3d hi, int depth) {
  Bounds bounds;
  for (const std::uint32_t i : list) bounds.add(parent.triangles[i]);
  const double pad = kReachMargin * parent.reach;
  for (int k = 0; k < 3; ++k) {
    lo[k] = std::max(lo[k], bounds.lo[k] - pad);
    hi[k] = std::min(hi[k], bounds.hi[k] + pad);
  }
  const auto size = static_cast<double>(list.size());
  const Content content{parent.triangles, list, lo, hi, parent.reach};
  Part child = sort_in(content, kChildDensity * size);
  if (static_cast<double>(child.references.size()) > kMaxCopies * size) return std::nullopt;
  split_crowds(content, child, depth + 1);
  return child;
}

/// The lower corner of the cell with this index.
Vec3d cell_corner(const Part& part, std::uint32_t index) {
  const auto nx = static_cast<std::uint32_t>(part.level.counts[0]);
  const auto ny = static_cast<std::uint32_t>(part.level.counts[1]);
  const std::uint32_t row = index / nx, x = index % nx, y = row % ny, z = row / ny;
  return part.level.lo + Vec3d(x, y, z) * part.cell_size;
}

/// Gives crowded cells grids.
void split_crowds(const Content& content, Part& part, int depth) {
  if (depth >= kMaxDepth) return;
  std::vector<std::uint32_t> crowded;
  for (std::uint32_t i = 0; i < part.level.cell_count(); ++i) {
    if (part.list(i).size() > kCrowd && part.list(i).size() < content.selected.size()) crowded.push_back(i);
  }
  if (crowded.empty()) return;
  std::vector<std::optional<Part>> children(crowded.size());
  parallel_for(crowded.size(), [&](std::size_t i) {
    const Vec3d lo = cell_corner(part, crowded[i]);
    children[i] = split_crowd(content, part.list(crowded[i]), lo - part.margin,
                              lo + part.cell_size + part.margin, depth);
  });
  for (std::size_t i = 0; i < crowded.size(); ++i) {
    if (!children[i]) continue;
    part.crowded.push_back(crowded[i]);
    part.children.push_back(std::move(*children[i]));
  }
}

/// Lists of references that are equal share their memory: cells that one large triangle passes through.
class DistinctLists {
 public:
  /// A record for the list, which is appended to `references` unless an equal one is known. Lists of several
  /// parts are not shared: their boxes are those of one cell.
  GridCells::Record add(std::span<const std::uint32_t> list, std::vector<std::uint32_t>& references) {
    std::uint64_t hash = list.size();
    for (const std::uint32_t i : list) hash = (hash ^ i) * 0x9E3779B97F4A7C15u, hash ^= hash >> 32;
    GridCells::Record& known = known_[hash % known_.size()];
    if (known.count == list.size() && list.size() <= GridCells::kFew &&
        std::equal(list.begin(), list.end(), references.begin() + known.begin))
      return known;
    references.resize(references.size() + GridCells::box_places(list.size()));
    known.begin = static_cast<std::uint32_t>(references.size());
    known.count = static_cast<std::uint32_t>(list.size());
    references.insert(references.end(), list.begin(), list.end());
    all_.push_back(known);
    return known;
  }

  [[nodiscard]] std::span<const GridCells::Record> all() const { return all_; }

 private:
  std::vector<GridCells::Record> known_{4096, GridCells::Record{}};  // the last with its hash
  std::vector<GridCells::Record> all_;
};

/// Appends the level of the part, without its children, and the records of its occupied cells. `children`
/// are the levels to come.
void append_level(const Part& part, std::uint32_t children, DistinctLists& lists, GridCells& grid) {
  GridLevel level = part.level;
  level.words = static_cast<std::uint32_t>(grid.occupied.size());
  level.near = static_cast<std::uint32_t>(grid.near.size());
  grid.near.resize(grid.near.size() + level.cell_count() / 4 + 1);
  grid.levels.push_back(level);
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < level.cell_count(); ++i) {
    if (i % 32 == 0) grid.occupied.push_back({0, static_cast<std::uint32_t>(grid.records.size())});
    const auto list = part.list(i);
    if (list.empty()) continue;
    grid.occupied.back().bits |= 1u << i % 32;
    if (next < part.crowded.size() && part.crowded[next] == i) {
      GridCells::Record& record = grid.records.emplace_back();
      record.begin = children + static_cast<std::uint32_t>(next++);
      record.count = GridCells::Record::kLevel;
    } else {
      grid.records.push_back(lists.add(list, grid.references));
    }
  }
}

/// The part and all below it, level by level.
void append(const Part& root, DistinctLists& lists, GridCells& grid) {
  std::vector<const Part*> parts{&root};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    append_level(*parts[i], static_cast<std::uint32_t>(parts.size()), lists, grid);
    for (const Part& child : parts[i]->children) parts.push_back(&child);
  }
}

void pack_vertices(std::span<const Triangle> triangles, std::span<const GridCells::Record> lists,
                   GridCells& grid) {
  parallel_chunks(lists.size(), [&](std::size_t i) {
    const GridCells::Record& list = lists[i];
    for (std::size_t j = 0; j < list.count; ++j) {
      const std::size_t in_part = j % GridCells::kPart, part = j - in_part;
      const std::size_t size = std::min(GridCells::kPart, list.count - part);
      float* out = grid.vertices.data() + 9 * (list.begin + part) + in_part;
      const Triangle& t = triangles[grid.references[list.begin + j]];
      const std::array<float, 9> coordinates{t.v0.x, t.v0.y, t.v0.z, t.v1.x, t.v1.y,
                                             t.v1.z, t.v2.x, t.v2.y, t.v2.z};
      for (std::size_t a = 0; a < 9; ++a) out[a * size] = coordinates[a];
    }
  });
}

}  // namespace

std::size_t GridCells::memory_bytes() const {
  return levels.capacity() * sizeof(GridLevel) + occupied.capacity() * sizeof(Word) +
         near.capacity() * sizeof(std::uint32_t) + records.capacity() * sizeof(Record) +
         references.capacity() * sizeof(std::uint32_t) + vertices.capacity() * sizeof(float);
}

GridCells build_grid_cells(std::span<const Triangle> triangles, const GridResolution& resolution) {
  GridCells grid;
  if (triangles.empty()) return grid;
  const Bounds bounds = bounds_of(triangles);
  const Vec3d lo(bounds.lo), hi(bounds.hi);
  const double reach = max_norm(hi - lo);
  // Widened by some roundings, so that no triangle lies on the boundary.
  const double pad = 16 * kRoundoff * (reach + std::max(max_norm(lo), max_norm(hi)));
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  if (reach >= kSmallestScene) {
    grid.trusted_lo = Vec3(hi - Vec3d(kTrustedSizes * reach));
    grid.trusted_hi = Vec3(lo + Vec3d(kTrustedSizes * reach));
  }
  grid.lo = lo;
  grid.hi = hi;
  const Content scene{triangles, all, lo - Vec3d(pad), hi + Vec3d(pad), reach};
  Part part = sort_in(scene, target_cells(resolution, triangles, hi - lo));
  split_crowds(scene, part, 0);
  DistinctLists lists;
  append(part, lists, grid);
  parallel_for(grid.levels.size(), [&](std::size_t i) { mark_near(grid.levels[i], grid); });
  grid.references.resize(grid.references.size() + GridCells::kOverread);
  grid.vertices.resize(9 * grid.references.size());
  fit_boxes(triangles, {kCellMargin, kReachMargin * reach}, grid);
  pack_vertices(triangles, lists.all(), grid);
  return grid;
}

}  // namespace lemma
