// Included once for every instruction set that accel/grid_trace.cpp is compiled for.
#if defined(LEMMA_GRID_SLICES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LEMMA_GRID_SLICES_INL_H
#undef LEMMA_GRID_SLICES_INL_H
#else
#define LEMMA_GRID_SLICES_INL_H
#endif

#include <bit>
#include <cmath>
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
    const Floats leave = hn::Add(hn::Iota(f, 0), hn::Set(f, static_cast<float>(first) + ray.to_plane));
    const Floats enter = hn::Max(hn::Sub(leave, hn::Set(f, 1)), hn::Zero(f));
    const Part u(ray.side[0], enter, leave), v(ray.side[1], enter, leave);
    const auto between = hn::RebindMask(n, hn::And(u.between, v.between));
    leaves_ = !hn::AllTrue(n, between);
    const auto in_grid = hn::And(hn::Lt(lane, hn::Set(n, ray.slices_ahead - first)), between);
    const auto wanted = hn::And(hn::Lt(lane, hn::Set(n, end - first)), in_grid);
    const Ints slice = hn::Add(hn::Mul(lane, hn::Set(n, ray.step)), hn::Set(n, ray.slice + first * ray.step));
    const Ints a = hn::Add(slice, hn::Add(u.index, v.index));
    const auto u_first = hn::RebindMask(
        n, hn::Lt(hn::Mul(u.to_turn, hn::Set(f, v.speed)), hn::Mul(v.to_turn, hn::Set(f, u.speed))));
    const Ints low = hn::IfThenElseZero(in_grid, hn::Add(a, hn::Add(u.low, v.low)));
    const Ints word = hn::GatherIndex(n, reinterpret_cast<const int*>(near), hn::ShiftRight<2>(low));
    const Ints shift = hn::ShiftLeft<3>(hn::And(low, hn::Set(n, 3)));
    const auto keep = [&](std::size_t order, Ints cell, Ints place, hn::Mask<I> passed) {
      hn::Store(cell, n, cells_ + 16 * order);
      const Ints bit = hn::Shl(hn::Set(n, 1), hn::Add(shift, place));
      return spread(bits_of(n, hn::And(hn::TestBit(word, bit), passed))) << order;
    };
    bits_ = keep(0, a, hn::Add(u.from, v.from), wanted);
    bits_ |= keep(1, hn::Add(a, hn::IfThenElse(u_first, u.turn, v.turn)),
                  hn::IfThenElse(u_first, hn::Add(u.to, v.from), hn::Add(u.from, v.to)),
                  hn::And(wanted, hn::And(u.turns, v.turns)));
    bits_ |= keep(2, hn::Add(a, hn::Add(u.turn, v.turn)), hn::Add(u.to, v.to),
                  hn::And(wanted, hn::Or(u.turns, v.turns)));
  }

  /// Whether the ray leaves the grid by a side before it enters the last of these slices.
  [[nodiscard]] HWY_INLINE bool leaves() const { return leaves_; }
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
  /// The ray's way on a side axis in each slice.
  struct Part {
    HWY_INLINE Part(const GridCrossing::Side& side, Floats enter, Floats leave) {
      const Floats start = hn::Set(f, side.start), slope = hn::Set(f, side.slope);
      const Floats begin = hn::MulAdd(enter, slope, start);
      const Ints first = nearest(begin, side.last),
                 last = nearest(hn::MulAdd(leave, slope, start), side.last);
      const float middle = 0.5f * static_cast<float>(side.last);
      between = hn::Le(hn::Abs(hn::Sub(begin, hn::Set(f, middle))), hn::Set(f, middle + 0.5f + kSlack));
      turns = hn::Ne(first, last);
      const auto where_it_turns = [&](int x) { return hn::IfThenElseZero(turns, hn::Set(n, x)); };
      const int down = side.slope > 0 ? 0 : -1;  // no bits or all
      index = hn::Mul(hn::Sub(first, hn::Set(n, kIntegers)), hn::Set(n, side.stride));
      turn = where_it_turns((side.stride ^ down) - down);
      low = where_it_turns(-(side.stride & down));
      from = where_it_turns(side.neighbour & down);
      to = where_it_turns(side.neighbour & ~down);
      const Floats centre = hn::Sub(hn::BitCast(f, first), hn::BitCast(f, hn::Set(n, kIntegers)));
      to_turn = hn::Abs(hn::Add(centre, hn::Set(f, std::copysign(0.5f, side.slope) - side.start)));
      speed = std::abs(side.slope);
    }

    Ints index, turn;     // its part of the first cell's index, and the change where it goes to the next cell
    Ints low, from, to;   // the change to the lower of both cells; places of both in GridCells::near
    hn::Mask<I> turns;    // whether it does go
    hn::Mask<F> between;  // whether it is between the grid's sides
    Floats to_turn;       // cells to where it turns
    float speed;          // cells a slice
  };

  /// So far beyond a side a ray may seem to be that is not: twice GridCrossing::kError [cells].
  static constexpr float kSlack = 2 * static_cast<float>(GridCrossing::kError);

  /// The bits of 2^23: floats from there to 2^24 are the integers, and their bits count on.
  static constexpr int kIntegers = 0x4B000000;

  /// kIntegers + the number from 0 to `last` that is nearest to x; one of them where x is not a number.
  static HWY_INLINE Ints nearest(Floats x, int last) {
    const Ints bits = hn::BitCast(n, hn::Add(x, hn::BitCast(f, hn::Set(n, kIntegers))));
    return hn::Min(hn::Max(bits, hn::Set(n, kIntegers)), hn::Set(n, kIntegers + last));
  }

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
  bool leaves_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#endif
