// Included once for every instruction set that accel/grid_trace.cpp is compiled for.
#if defined(LEMMA_GRID_LISTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LEMMA_GRID_LISTS_INL_H
#undef LEMMA_GRID_LISTS_INL_H
#else
#define LEMMA_GRID_LISTS_INL_H
#endif

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
    const std::size_t parts = GridCells::part_count(list.count);
    const float* boxes = grid.part_boxes(list);
    for (std::size_t first = 0; first < parts; first += parts_.lanes()) {
      for (std::uint64_t rest = parts_.may_pass(boxes + first, parts, parts - first, best.t); rest != 0;
           rest &= rest - 1) {
        hit |= test_part(grid, list,
                         GridCells::kPart * (first + static_cast<std::size_t>(std::countr_zero(rest))), best);
        if (kAny && hit) return true;
      }
    }
    return hit;
  }

 private:
  static constexpr std::size_t kShort = 8;  // one look of FewTest

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
