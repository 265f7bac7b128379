// Included once for every instruction set that accel/grid_trace.cpp is compiled for.
#if defined(LEMMA_GRID_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LEMMA_GRID_BOXES_INL_H
#undef LEMMA_GRID_BOXES_INL_H
#else
#define LEMMA_GRID_BOXES_INL_H
#endif

#include <array>

#include "accel/grid_cells.h"
#include "accel/grid_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Which boxes of records a ray may pass within its range, up to kMost at a time. Source: Kay, Kajiya, Ray
/// Tracing Complex Scenes, SIGGRAPH 1986. Slabs err by 3 roundings of the distance between the ray's origin
/// and the box: the box is wider by more (fit_boxes). Where a ray in the plane of a slab makes 0 times
/// infinity, that width is what lies between it and all triangles, and either answer is right.
#if HWY_TARGET == HWY_SCALAR
template <std::size_t>
class BoxTest {
 public:
  static constexpr std::size_t kBoxes = 1;

  explicit BoxTest(const Ray& ray) : origin_(ray.origin), pace_(Vec3(1) / ray.direction), t_min_(ray.t_min) {}

  std::uint32_t may_pass(const std::array<const GridCells::Record*, kBoxes>& cells, float t_max) const {
    const Vec3 a = (cells[0]->lo - origin_) * pace_, b = (cells[0]->hi - origin_) * pace_;
    float enter = t_min_, leave = t_max;
    for (int k = 0; k < 3; ++k) {
      enter = std::max(enter, std::min(a[k], b[k]));
      leave = std::min(leave, std::max(a[k], b[k]));
    }
    return enter > leave ? 0 : 1;
  }

 private:
  const Vec3 origin_, pace_;
  const float t_min_;
};
#else
template <std::size_t kMost>
class BoxTest {
  using D = hn::CappedTag<float, 4 * kMost>;
  using Floats = hn::Vec<D>;
  static constexpr D d{};
  static constexpr hn::RebindToSigned<D> n{};

 public:
  /// So many at a time: each takes four lanes, for x y z and the range of t.
  static constexpr std::size_t kBoxes = hn::MaxLanes(d) / 4;

  HWY_INLINE explicit BoxTest(const Ray& ray)
      : origin_(load(ray.origin)), pace_(hn::Div(hn::Set(d, 1), load(ray.direction))), t_min_(ray.t_min) {}

  /// Bit 4 i is set if the ray may pass box i.
  HWY_INLINE std::uint32_t may_pass(const std::array<const GridCells::Record*, kBoxes>& cells,
                                    float t_max) const {
    const Floats a = hn::Mul(hn::Sub(corners(d, cells.data(), &GridCells::Record::lo), origin_), pace_);
    const Floats b = hn::Mul(hn::Sub(corners(d, cells.data(), &GridCells::Record::hi), origin_), pace_);
    const auto range = hn::RebindMask(d, hn::Eq(hn::And(hn::Iota(n, 0), hn::Set(n, 3)), hn::Set(n, 3)));
    const Floats enter = hn::IfThenElse(range, hn::Set(d, t_min_), hn::Min(a, b));
    Floats leave = hn::IfThenElse(range, hn::Set(d, t_max), hn::Max(a, b));
    leave = hn::Min(leave, hn::Shuffle1032(leave));
    leave = hn::Min(leave, hn::Shuffle2301(leave));
    if constexpr (kBoxes == 1) return hn::AllFalse(d, hn::Gt(enter, leave)) ? 1 : 0;
    auto misses = static_cast<std::uint32_t>(bits_of(d, hn::Gt(enter, leave)));
    misses |= misses >> 2;
    misses |= misses >> 1;
    return ~misses & 0x1111;
  }

 private:
  /// Lower or upper corners of as many cells as have room, with what follows them in the record.
  template <class T>
  static HWY_INLINE hn::Vec<T> corners(T tag, const GridCells::Record* const* cells,
                                       Vec3 GridCells::Record::*corner) {
    if constexpr (hn::MaxLanes(tag) == 4) {
      return hn::Load(tag, &(cells[0]->*corner).x);
    } else {
      const hn::Half<T> half;
      return hn::Combine(tag, corners(half, cells + hn::MaxLanes(half) / 4, corner),
                         corners(half, cells, corner));
    }
  }
  static HWY_INLINE Floats load(const Vec3& v) {
    alignas(16) const float lanes[4] = {v.x, v.y, v.z, 1};
    return hn::LoadDup128(d, lanes);
  }

  const Floats origin_, pace_;
  const float t_min_;
};
#endif

/// Which boxes of parts a ray may pass within its range, as many at a time as there are lanes.
class PartTest {
 public:
  HWY_INLINE explicit PartTest(const Ray& ray) : ray_(ray) {}
  static HWY_INLINE std::size_t lanes() { return hn::Lanes(d); }

  /// Bit i is set for box i of the first `count`, of which those of the lanes are tested.
  HWY_INLINE std::uint64_t may_pass(const float* boxes, std::size_t size, std::size_t count,
                                    float t_max) const {
    auto enter = hn::Set(d, ray_.t_min), leave = hn::Set(d, t_max);
    for (int k = 0; k < 3; ++k) {
      const auto origin = hn::Set(d, ray_.origin[k]), pace = hn::Set(d, 1 / ray_.direction[k]);
      const float* planes = boxes + static_cast<std::size_t>(k) * size;
      const auto a = hn::Mul(hn::Sub(hn::LoadU(d, planes), origin), pace);
      const auto b = hn::Mul(hn::Sub(hn::LoadU(d, planes + 3 * size), origin), pace);
      enter = hn::Max(enter, hn::Min(a, b));
      leave = hn::Min(leave, hn::Max(a, b));
    }
    return bits_of(d, hn::AndNot(hn::Gt(enter, leave), hn::FirstN(d, count)));
  }

 private:
  static constexpr hn::CappedTag<float, 16> d{};
  const Ray& ray_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#endif
