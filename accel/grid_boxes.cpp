#include "accel/grid_boxes.h"

#include <algorithm>
#include <utility>

#include "src/core/bounds.h"
#include "src/core/error_bound.h"
#include "src/core/parallel.h"

namespace lemma {
namespace {

constexpr std::uint32_t kChunk = 1u << 10;  // cells that one task fits

struct Box {
  Vec3d lo, hi;
};

/// The part of a triangle in a box.
class Polygon {
 public:
  explicit Polygon(const Triangle& t) : corners_{Vec3d(t.v0), Vec3d(t.v1), Vec3d(t.v2)} {}

  void clip_to(const Box& box, const Bounds& triangle) {
    for (int k = 0; k < 3; ++k) {
      if (triangle.lo[k] < box.lo[k]) clip([&](const Vec3d& p) { return p[k] - box.lo[k]; });
      if (triangle.hi[k] > box.hi[k]) clip([&](const Vec3d& p) { return box.hi[k] - p[k]; });
    }
  }
  [[nodiscard]] std::span<const Vec3d> corners() const { return {corners_.data(), count_}; }

 private:
  /// Leaves what is not below zero. Source: Sutherland, Hodgman, Reentrant Polygon Clipping, CACM 17(1),
  /// 1974.
  template <class Height>
  void clip(const Height& height) {
    std::array<double, kMost> heights;
    for (std::size_t i = 0; i < count_; ++i) heights[i] = height(corners_[i]);
    std::array<Vec3d, kMost> before;
    std::copy_n(corners_.begin(), count_, before.begin());
    const std::size_t sides = std::exchange(count_, 0);
    for (std::size_t i = 0, j = 1; i < sides; ++i, ++j) {
      if (j == sides) j = 0;
      if (heights[i] >= 0) corners_[count_++] = before[i];
      if ((heights[i] >= 0) == (heights[j] >= 0)) continue;
      corners_[count_++] = before[i] + (before[j] - before[i]) * (heights[i] / (heights[i] - heights[j]));
    }
  }

  /// A plane adds one corner to a convex polygon, but where rounding makes it zigzag across the plane, half
  /// as many as it has: from 3 to 4, 6, 9, 13, 19 and 28 with the six of a box.
  static constexpr std::size_t kMost = 28;
  std::array<Vec3d, kMost> corners_;
  std::size_t count_ = 3;
};

/// The cell, margins included.
Box wide_cell(const GridMargins& margins, const GridLevel& level, std::uint32_t index) {
  const auto nx = static_cast<std::uint32_t>(level.counts[0]),
             ny = static_cast<std::uint32_t>(level.counts[1]);
  const std::uint32_t ix = index % nx, iy = index / nx % ny, iz = index / nx / ny;
  const Vec3d place(ix, iy, iz), size = Vec3d(1) / level.cells_per_unit;
  const Vec3d margin = size * margins.cell + Vec3d(margins.reach);
  return {level.lo + place * size - margin, level.lo + (place + Vec3d(1)) * size + margin};
}

/// Bounds of the triangle's part in the box, each coordinate rounded to the next float. Of a triangle smaller
/// than the box on each axis, those of its own bounds' part, which are about as tight and found in a tenth of
/// the time.
Bounds bounds_within(const Box& box, const Triangle& triangle) {
  Bounds whole, part;
  whole.add(triangle);
  bool inside = true, small = true;
  for (int k = 0; k < 3; ++k) {
    inside &= whole.lo[k] >= box.lo[k] && whole.hi[k] <= box.hi[k];
    small &= whole.hi[k] - whole.lo[k] < box.hi[k] - box.lo[k];
    part.lo[k] = std::max(whole.lo[k], static_cast<float>(box.lo[k]));
    part.hi[k] = std::min(whole.hi[k], static_cast<float>(box.hi[k]));
    small &= part.lo[k] <= part.hi[k];
  }
  if (inside) return whole;
  if (small) return part;
  part = {};
  Polygon polygon(triangle);
  polygon.clip_to(box, whole);
  for (const Vec3d& corner : polygon.corners()) part.add(Vec3(corner));
  return part.empty() ? whole : part;  // the list holds what passes within rounding
}

/// Wider than the error of hits by as much again for that of the slabs and for rounding.
Bounds widened(Bounds box, const GridMargins& margins) {
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = next_float_towards(static_cast<float>(box.lo[k] - 2 * margins.reach), -1);
    box.hi[k] = next_float_towards(static_cast<float>(box.hi[k] + 2 * margins.reach), 1);
  }
  return box;
}

/// A triangle of a list and the box of its part in the cell.
struct Item {
  std::uint32_t triangle;
  Bounds box;

  [[nodiscard]] float centre(int axis) const { return box.lo[axis] + box.hi[axis]; }
};

Bounds bounds_of(std::span<const Item> items) {
  Bounds bounds;
  for (const Item& item : items) bounds.add(item.box.lo), bounds.add(item.box.hi);
  return bounds;
}

/// Halves the items along the axis on which their centres lie furthest apart until halves are parts; whole
/// groups of parts first.
void sort_into_parts(std::span<Item> items) {
  const std::size_t parts = GridCells::part_count(items.size());
  if (parts == 1) {
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return a.triangle < b.triangle; });
    return;
  }
  Bounds centres;
  for (const Item& item : items) centres.add(Vec3(item.centre(0), item.centre(1), item.centre(2)));
  const Vec3 size = centres.hi - centres.lo;
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const std::size_t unit = parts > GridCells::kGroup ? GridCells::kGroup : 1;
  const std::size_t half = std::max(parts / 2 / unit, std::size_t{1}) * unit * GridCells::kPart;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](const Item& a, const Item& b) {
                     return std::pair(a.centre(axis), a.triangle) < std::pair(b.centre(axis), b.triangle);
                   });
  sort_into_parts(items.first(half));
  sort_into_parts(items.subspan(half));
}

/// Fits boxes to the cells of one grid.
class Fitting {
 public:
  Fitting(std::span<const Triangle> triangles, const GridMargins& margins, GridCells& grid)
      : triangles_(triangles), margins_(margins), grid_(grid) {}

  /// Of a list.
  void fit(const Box& cell, GridCells::Record& list) const {
    Bounds box;
    std::vector<Item> items;
    const bool parts = list.count > GridCells::kFew;
    for (std::size_t i = list.begin; i < list.begin + list.count; ++i) {
      const std::uint32_t triangle = grid_.references[i];
      const Bounds bounds = bounds_within(cell, triangles_[triangle]);
      box.add(bounds.lo), box.add(bounds.hi);
      if (parts) items.push_back({triangle, bounds});
    }
    const Bounds wide = widened(box, margins_);
    list.lo = wide.lo, list.hi = wide.hi;
    if (parts) fit_parts(items, list);
  }

 private:
  void fit_parts(std::span<Item> items, const GridCells::Record& list) const {
    sort_into_parts(items);
    for (std::size_t i = 0; i < items.size(); ++i) grid_.references[list.begin + i] = items[i].triangle;
    fit_in_turn(items, GridCells::kPart, grid_.part_boxes(list));
    if (GridCells::group_count(items.size()) > 0)
      fit_in_turn(items, GridCells::kPart * GridCells::kGroup, grid_.group_boxes(list));
  }

  /// Boxes of `each` items and a last one of the rest.
  void fit_in_turn(std::span<Item> items, std::size_t each, float* boxes) const {
    const std::size_t count = (items.size() + each - 1) / each;
    for (std::size_t i = 0; i < count; ++i) {
      const Bounds box =
          widened(bounds_of(items.subspan(i * each, std::min(each, items.size() - i * each))), margins_);
      const std::array<float, 6> values{box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z};
      for (std::size_t a = 0; a < 6; ++a) boxes[a * count + i] = values[a];
    }
  }

  std::span<const Triangle> triangles_;
  const GridMargins& margins_;
  GridCells& grid_;
};

/// The records of a level.
std::span<GridCells::Record> records_of(GridCells& grid, const GridLevel& level) {
  const std::size_t begin = grid.occupied[level.words].before;
  const std::size_t next = level.words + (level.cell_count() + 31) / 32;
  const std::size_t end = next < grid.occupied.size() ? grid.occupied[next].before : grid.records.size();
  return {grid.records.data() + begin, grid.records.data() + end};
}

}  // namespace

void fit_boxes(std::span<const Triangle> triangles, const GridMargins& margins, GridCells& grid) {
  const Fitting fitting(triangles, margins, grid);
  std::vector<std::pair<const GridLevel*, std::uint32_t>> tasks;  // cells of a level from one on
  for (const GridLevel& level : grid.levels) {
    for (std::uint32_t i = 0; i < level.cell_count(); i += kChunk) tasks.emplace_back(&level, i);
  }
  parallel_for(tasks.size(), [&](std::size_t task) {
    const auto [level, first] = tasks[task];
    for (std::uint32_t i = first; i < std::min(first + kChunk, level->cell_count()); ++i) {
      if (!grid.is_occupied(*level, i)) continue;
      GridCells::Record& record = grid.record(*level, i);
      if (record.count != GridCells::Record::kLevel) fitting.fit(wide_cell(margins, *level, i), record);
    }
  });
  for (auto level = grid.levels.rbegin(); level != grid.levels.rend();
       ++level) {  // those in cells come later
    for (GridCells::Record& record : records_of(grid, *level)) {
      if (record.count != GridCells::Record::kLevel) continue;
      Bounds box;
      for (const GridCells::Record& part : records_of(grid, grid.levels[record.begin]))
        box.add(part.lo), box.add(part.hi);
      record.lo = box.lo, record.hi = box.hi;
    }
  }
}

}  // namespace lemma
