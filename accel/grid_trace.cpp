#include "accel/grid_trace.h"

#include <array>
#include <bit>

#include "src/core/instruction_sets.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/grid_trace.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "accel/grid_boxes-inl.h"
#include "accel/grid_lists-inl.h"
#include "accel/grid_slices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

/// The lists last tested: cells that one large triangle passes through share theirs (build_grid_cells).
class LastLists {
 public:
  /// Whether the list is none of these; from now on it is.
  HWY_INLINE bool is_new(std::uint32_t list) {
    if (list == last_ || list == before_) return false;
    before_ = last_;
    last_ = list;
    return true;
  }

 private:
  std::uint32_t last_ = GridCells::Record::kLevel, before_ = GridCells::Record::kLevel;
};

/// Walks through grids and tests the cells. A hit may lie beyond its cell: it stands only when no later cell
/// can hold a nearer one, which is why the walk reaches as far as best.t.
template <bool kAny>
class Walk {
  using Boxes = BoxTest<kAny ? 4 : 1>;

 public:
  HWY_INLINE Walk(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best)
      : grid_(grid), ray_(ray), test_(ray, sheared), box_(ray), best_(best) {}

  /// Through one level and those of its cells; says whether there is a hit, if any will do.
  bool through(const GridLevel& level) {
    const GridCrossing crossing(level, ray_, best_.t);
    bool hit = false;
    int end = crossing.slices;
    for (int first = 0; first < end; first += Slices::lanes()) {
      Slices slices(grid_.near.data() + level.near, crossing, first, end);
      if (slices.leaves()) end = std::min(end, first + Slices::lanes());
      if constexpr (kAny) {
        if (hits_any(level, slices)) return true;
      } else {
        for (; !slices.done() && slices.slice() < end; slices.next()) {
          const GridCells::Record& cell = grid_.record(level, slices.cell());
          if (box_.may_pass({&cell}, best_.t) == 0 || !visit(cell)) continue;
          hit = true;
          end = std::min(end, crossing.slices_until(best_.t));
        }
      }
    }
    return hit;
  }

 private:
  /// Tests the boxes of all cells first, several at a time: which rays pass is hard to predict, and most such
  /// rays get to the last cell. The closest hit is in one of the first.
  HWY_INLINE bool hits_any(const GridLevel& level, Slices& slices) {
    std::array<const GridCells::Record*, Slices::kMostCells> passed;
    std::size_t count = 0;
    while (!slices.done()) {
      std::array<const GridCells::Record*, Boxes::kBoxes> cells;
      const std::uint32_t wanted = take(level, slices, cells);
      const std::uint32_t bits = box_.may_pass(cells, best_.t) & wanted;
      for (std::size_t i = 0; i < Boxes::kBoxes; ++i) {
        passed[count] = cells[i];
        count += bits >> 4 * i & 1;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (visit(*passed[i])) return true;
    }
    return false;
  }

  /// The next cells, as many as boxes are tested at a time; bit 4 i is set if there is one for cells[i].
  HWY_INLINE std::uint32_t take(const GridLevel& level, Slices& slices,
                                std::array<const GridCells::Record*, Boxes::kBoxes>& cells) const {
    std::uint32_t wanted = 0;
    bool more = true;
    for (std::size_t i = 0; i < Boxes::kBoxes; ++i) {
      cells[i] = &grid_.record(level, slices.cell());
      wanted |= (more ? 1u : 0u) << 4 * i;
      more = more && slices.next_or_stay();
    }
    if (!more) slices.finish();
    return wanted;
  }

  HWY_INLINE bool visit(const GridCells::Record& cell) {
    if (cell.count == GridCells::Record::kLevel) return through(grid_.levels[cell.begin]);
    return tested_.is_new(cell.begin) && test_(grid_, cell, best_);
  }

  const GridCells& grid_;
  const Ray& ray_;
  const CellTest<kAny> test_;
  const Boxes box_;
  Hit& best_;
  LastLists tested_;
};

void closest(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best) {
  Walk<false>(grid, ray, sheared, best).through(grid.levels.front());
}

bool any(const GridCells& grid, const Ray& ray, const ShearedRay& sheared) {
  Hit best = no_hit(sheared);
  return Walk<true>(grid, ray, sheared, best).through(grid.levels.front());
}

void walk(const GridCells& grid, const Ray& ray, std::vector<std::uint32_t>& cells) {
  const GridLevel& level = grid.levels.front();
  const GridCrossing crossing(level, ray, ray.t_max);
  bool leaves = false;
  for (int first = 0; first < crossing.slices && !leaves; first += Slices::lanes()) {
    Slices slices(grid.near.data() + level.near, crossing, first, crossing.slices);
    leaves = slices.leaves();
    for (; !slices.done(); slices.next()) cells.push_back(slices.cell());
  }
}

}  // namespace

GridTrace grid_trace() {
  return {closest, any, walk, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(grid_trace);

const std::vector<GridTrace>& grid_traces() {
  static const std::vector<GridTrace> traces =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(grid_trace)(); });
  return traces;
}

}  // namespace lemma
#endif
