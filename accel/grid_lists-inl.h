// Included once for every instruction set that accel/grid_trace.cpp is compiled for.
#if defined(LEMMA_GRID_LISTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LEMMA_GRID_LISTS_INL_H
#undef LEMMA_GRID_LISTS_INL_H
#else
#define LEMMA_GRID_LISTS_INL_H
#endif

#include <bit>

#include "accel/grid_blocks-inl.h"
#include "accel/grid_boxes-inl.h"
#include "accel/grid_cells.h"

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Tests the triangles of cells, many at a time: hits are those of brute force to the bit.
template <bool kAny>
class CellTest {
 public:
  HWY_INLINE CellTest(const Ray& ray, const ShearedRay& sheared)
      : parts_(ray), few_(sheared), many_(sheared) {}

  /// intersect() with the triangles of the cell's list.
  HWY_INLINE bool operator()(const GridCells& grid, const GridCells::Record& list, Hit& best) const {
    if (list.count <= kShort)
      return few_(grid.packed(list.begin), grid.references.data() + list.begin, list.count, best);
    bool hit = false;
    if (list.count <= GridCells::kFew) {
      for (std::size_t i = 0; i < list.count; i += GridCells::kPart) {
        hit |= test_part(grid, list, i, best);
        if (kAny && hit) return true;
      }
      return hit;
    }
    const std::size_t parts = GridCells::part_count(list.count), groups = GridCells::group_count(list.count);
    if (groups == 0) return test_parts(grid, list, 0, parts, best);
    return visit_passed(grid.group_boxes(list), groups, 0, groups, best, [&](std::size_t group) {
      const std::size_t first = GridCells::kGroup * group;
      return test_parts(grid, list, first, std::min(first + GridCells::kGroup, parts), best);
    });
  }

 private:
  static constexpr std::size_t kShort = 8;  // one look of FewTest

  /// Calls visit(i) for those of the boxes in [first, end) that the ray may pass before best.t, up to a hit
  /// if any will do; whether one of the calls said that there is a hit.
  template <class Visit>
  HWY_INLINE bool visit_passed(const float* boxes, std::size_t size, std::size_t first, std::size_t end,
                               const Hit& best, const Visit& visit) const {
    bool hit = false;
    for (; first < end; first += parts_.lanes()) {
      for (std::uint64_t rest = parts_.may_pass(boxes + first, size, end - first, best.t); rest != 0;
           rest &= rest - 1) {
        hit |= visit(first + static_cast<std::size_t>(std::countr_zero(rest)));
        if (kAny && hit) return true;
      }
    }
    return hit;
  }

  /// The parts in [first, end).
  HWY_INLINE bool test_parts(const GridCells& grid, const GridCells::Record& list, std::size_t first,
                             std::size_t end, Hit& best) const {
    return visit_passed(
        grid.part_boxes(list), GridCells::part_count(list.count), first, end, best,
        [&](std::size_t part) { return test_part(grid, list, GridCells::kPart * part, best); });
  }

  HWY_INLINE bool test_part(const GridCells& grid, const GridCells::Record& list, std::size_t first,
                            Hit& best) const {
    const std::size_t begin = list.begin + first, size = std::min(GridCells::kPart, list.count - first);
    return many_(grid.packed(begin), grid.references.data() + begin, size, best);
  }

  const PartTest parts_;
  const FewTest<kAny> few_;
  const BlockTest<kAny, GridCells::kOverread> many_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#endif
