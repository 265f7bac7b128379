// Included once for every instruction set that accel/grid_trace.cpp is compiled for.
#if defined(LEMMA_GRID_SLICES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LEMMA_GRID_SLICES_INL_H
#undef LEMMA_GRID_SLICES_INL_H
#else
#define LEMMA_GRID_SLICES_INL_H
#endif

#include <bit>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "accel/grid_lanes-inl.h"
#include "accel/grid_walk.h"

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many slices of a grid at a time as there are lanes: a 3D DDA in parallel. In each slice the ray passes
/// one to three cells. Source: Amanatides, Woo, A Fast Voxel Traversal Algorithm for Ray Tracing,
/// Eurographics 1987; by slices after Wald, Ize, Kensler, Knoll, Parker, Ray Tracing Animated Scenes using
/// Coherent Grid Traversal, ACM TOG 25(3), 2006, where they cut packets of rays.
///
/// One look tells of all these cells whether they are occupied (GridCells::near).
///
/// Where a ray passes a cell's edge or corner within rounding either neighbour may be left out or come first:
/// the margin of the cells covers both.
class Slices {
 public:
  using F = hn::CappedTag<float, 16>;
  using I = hn::RebindToSigned<F>;
  using Floats = hn::Vec<F>;
  using Ints = hn::Vec<I>;
  static constexpr F f{};
  static constexpr I n{};
  static constexpr std::size_t kMostCells = 48;
  static HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(f)); }

  /// Finds the occupied cells of the slices in [first, end) of which there are lanes.
  HWY_INLINE Slices(const std::uint32_t* near, const GridCrossing& ray, int first, int end) : first_(first) {
    const Ints lane = hn::Iota(n, 0);
    const Floats leave =
        hn::Add(hn::ConvertTo(f, lane), hn::Set(f, static_cast<float>(first) + ray.to_plane));
    const Floats enter = hn::Max(hn::Sub(leave, hn::Set(f, 1)), hn::Zero(f));
    const auto inside = hn::Lt(lane, hn::Set(n, end - first));
    const Part u(ray.side[0], enter, leave), v(ray.side[1], enter, leave);
    const int stride = ray.step * ray.stride;
    const Ints slice =
        hn::Add(hn::Mul(lane, hn::Set(n, stride)), hn::Set(n, ray.slice * ray.stride + first * stride));
    const Ints a = hn::Add(slice, hn::Add(u.index, v.index));
    const auto u_first = hn::RebindMask(n, hn::Lt(u.turns_at, v.turns_at));
    const Ints low = hn::IfThenElseZero(inside, hn::Add(a, hn::Add(u.low, v.low)));
    const Ints word = hn::GatherIndex(n, reinterpret_cast<const int*>(near), hn::ShiftRight<2>(low));
    const Ints shift = hn::ShiftLeft<3>(hn::And(low, hn::Set(n, 3)));
    const auto keep = [&](std::size_t order, Ints cell, Ints place, hn::Mask<I> wanted) {
      hn::Store(cell, n, cells_ + 16 * order);
      const Ints bit = hn::Shl(hn::Set(n, 1), hn::Add(shift, place));
      return spread(bits_of(n, hn::And(hn::TestBit(word, bit), wanted))) << order;
    };
    bits_ = keep(0, a, hn::Add(u.from, v.from), inside);
    bits_ |= keep(1, hn::Add(a, hn::IfThenElse(u_first, u.turn, v.turn)),
                  hn::IfThenElse(u_first, hn::Add(u.to, v.from), hn::Add(u.from, v.to)),
                  hn::And(inside, hn::And(u.turns, v.turns)));
    bits_ |= keep(2, hn::Add(a, hn::Add(u.turn, v.turn)), hn::Add(u.to, v.to),
                  hn::And(inside, hn::Or(u.turns, v.turns)));
  }

  [[nodiscard]] HWY_INLINE bool done() const { return bits_ == 0; }
  HWY_INLINE void next() { bits_ &= bits_ - 1; }
  /// next(), but stays at the last cell; whether it could.
  HWY_INLINE bool next_or_stay() {
    const std::uint64_t rest = bits_ & (bits_ - 1);
    bits_ = rest != 0 ? rest : bits_;
    return rest != 0;
  }
  HWY_INLINE void finish() { bits_ = 0; }
  [[nodiscard]] HWY_INLINE std::uint32_t cell() const { return static_cast<std::uint32_t>(cells_[place()]); }
  /// Of the cell, from where the ray enters the grid.
  [[nodiscard]] HWY_INLINE int slice() const { return first_ + std::countr_zero(bits_) / 4; }

 private:
  static HWY_INLINE Ints clamp(Ints x, int last) {
    return hn::Min(hn::Max(x, hn::Zero(n)), hn::Set(n, last));
  }

  /// The ray's way on a side axis in each slice.
  struct Part {
    HWY_INLINE Part(const GridCrossing::Side& side, Floats enter, Floats leave) {
      const Floats start = hn::Set(f, side.start), slope = hn::Set(f, side.slope);
      const auto place = [&](Floats x) {
        return clamp(hn::ConvertTo(n, hn::Add(hn::Mul(x, slope), start)), side.last);
      };
      const Ints first = place(enter), last = place(leave);
      const auto moves = hn::Ne(first, last);
      const auto where_it_turns = [&](int x) { return hn::IfThenElseZero(moves, hn::Set(n, x)); };
      const bool up = side.slope > 0;
      index = hn::Mul(first, hn::Set(n, side.stride));
      turn = where_it_turns(up ? side.stride : -side.stride);
      low = where_it_turns(up ? 0 : -side.stride);
      from = where_it_turns(up ? 0 : side.neighbour);
      to = where_it_turns(up ? side.neighbour : 0);
      turns = moves;
      const Floats plane = hn::ConvertTo(f, hn::Add(first, hn::Set(n, up ? 1 : 0)));
      turns_at = hn::Mul(hn::Sub(plane, start), hn::Set(f, side.pace));
    }

    Ints index, turn;    // its part of the first cell's index, and the change where it goes to the next cell
    Ints low, from, to;  // the change to the lower of both cells; places of both in GridCells::near
    hn::Mask<I> turns;   // whether it does go
    Floats turns_at;     // and where
  };

  /// Bit i becomes bit 4 i.
  static HWY_INLINE std::uint64_t spread(std::uint64_t bits) {
#if HWY_TARGET <= HWY_AVX3  // where pdep is fast
    return _pdep_u64(bits, 0x1111111111111111);
#else
    bits = (bits | bits << 24) & 0x000000FF000000FF;
    bits = (bits | bits << 12) & 0x000F000F000F000F;
    bits = (bits | bits << 6) & 0x0303030303030303;
    return (bits | bits << 3) & 0x1111111111111111;
#endif
  }

  [[nodiscard]] HWY_INLINE std::size_t place() const {
    const auto bit = static_cast<std::size_t>(std::countr_zero(bits_));
    return 16 * (bit % 4) + bit / 4;
  }

  alignas(64) int cells_[kMostCells];
  std::uint64_t bits_;
  int first_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#endif
