#include "accel/grid_trace.h"

#include <bit>
#include <cstring>

#include "accel/grid_walk.h"
#include "src/core/instruction_sets.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/grid_trace.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// Eight lanes: cells hold few triangles, and 16 measured slower.
using Lanes = hn::CappedTag<float, GridCells::kOverread>;
using Floats = hn::Vec<Lanes>;
constexpr Lanes kLanes;

/// b.x c.y - b.y c.x, of the right sign or, in doubt, 0. Where products are fused the second line adds what
/// the first lost to the rounding of b.y c.x: the sum is 0 only if the value is, and else has its sign.
/// Source: Jeannerod, Louvet, Muller, Further Analysis of Kahan's Algorithm for the Accurate Computation of 2
/// x 2 Determinants, Mathematics of Computation 82, 2013. Elsewhere the three roundings err by less than
/// 2^-23 of the products, and what is not twice as large counts as 0.
HWY_INLINE Floats edge(Floats bx, Floats by, Floats cx, Floats cy) {
  const Floats lost = hn::Mul(by, cx);
#if HWY_NATIVE_FMA
  return hn::Add(hn::MulSub(bx, cy, lost), hn::NegMulAdd(by, cx, lost));
#else
  const Floats kept = hn::Mul(bx, cy), value = hn::Sub(kept, lost);
  const Floats doubt = hn::Mul(hn::Add(hn::Abs(kept), hn::Abs(lost)), hn::Set(kLanes, 0x1p-22f));
  return hn::IfThenZeroElse(hn::Le(hn::Abs(value), doubt), value);
#endif
}

/// Products that underflow lose less than 2^-147 in edge(): beyond this its sign is right all the same.
constexpr float kTiny = 0x1p-126f;

/// Whether the values of edge() are precise too, to 2 roundings, and not their signs alone.
constexpr bool kPreciseEdges = HWY_NATIVE_FMA != 0;

/// Tests the triangles of cells, all lanes at a time. What lanes cannot rule out, the test of one triangle
/// decides: hits are those of brute force to the bit.
class CellTest {
 public:
  HWY_INLINE explicit CellTest(const ShearedRay& ray)
      : ray_(ray),
        sx_(hn::Set(kLanes, ray.sx)),
        sy_(hn::Set(kLanes, ray.sy)),
        ox_(hn::Set(kLanes, ray.origin[ray.kx])),
        oy_(hn::Set(kLanes, ray.origin[ray.ky])),
        oz_(hn::Set(kLanes, ray.origin[ray.kz])) {}

  /// intersect() with each triangle of the cell's list.
  template <bool kAny>
  HWY_INLINE bool operator()(const GridCells& grid, std::size_t cell, Hit& best) const {
    const std::size_t begin = grid.first[cell], size = grid.first[cell + 1] - begin;
    const float* packed = grid.packed(cell);
    bool hit = false;
    for (std::size_t i = 0; i < size; i += hn::Lanes(kLanes)) {
      for (std::uint64_t rest = candidates(packed + i, size, size - i, best.t); rest != 0; rest &= rest - 1) {
        const std::size_t j = i + static_cast<std::size_t>(std::countr_zero(rest));
        hit |= intersect(ray_, unpack(packed + j, size), grid.references[begin + j], best);
        if (kAny && hit) return true;
      }
    }
    return hit;
  }

 private:
  struct Vertices {
    Floats x, y, z;
  };
  struct Edges {
    Floats u, v, w;
  };

  /// shear() of accel/watertight.h, rounding for rounding.
  HWY_INLINE Vertices shear(const float* vertex, std::size_t size) const {
    const auto k = [&](int axis) {
      return hn::LoadU(kLanes, vertex + static_cast<std::size_t>(axis) * size);
    };
    const Floats z = hn::Sub(k(ray_.kz), oz_);
    return {hn::Sub(hn::Sub(k(ray_.kx), ox_), hn::Mul(sx_, z)),
            hn::Sub(hn::Sub(k(ray_.ky), oy_), hn::Mul(sy_, z)), z};
  }

  /// Bit i is set if the ray may hit triangle i of `count` at a t up to `t_max`.
  /// @param size  distance between the arrays of packed vertices
  HWY_INLINE std::uint64_t candidates(const float* packed, std::size_t size, std::size_t count,
                                      float t_max) const {
    const Vertices a = shear(packed, size), b = shear(packed + 3 * size, size),
                   c = shear(packed + 6 * size, size);
    const Edges e{edge(c.x, c.y, b.x, b.y), edge(a.x, a.y, c.x, c.y), edge(b.x, b.y, a.x, a.y)};
    auto may_hit = hn::And(line_may_pass(e), hn::FirstN(kLanes, count));
    if (HWY_LIKELY(hn::AllFalse(kLanes, may_hit))) return 0;
    if constexpr (kPreciseEdges) may_hit = hn::And(may_hit, distance_may_count(e, a.z, b.z, c.z, t_max));
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(kLanes, may_hit, bytes);
    std::uint64_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits;
  }

  /// No two edge functions have opposite signs. Not a number compares as false and so rules out nothing.
  static HWY_INLINE hn::Mask<Lanes> line_may_pass(const Edges& e) {
    const Floats least = hn::Min(hn::Min(e.u, e.v), e.w), most = hn::Max(hn::Max(e.u, e.v), e.w);
    return hn::Not(hn::And(hn::Lt(least, hn::Set(kLanes, -kTiny)), hn::Gt(most, hn::Set(kLanes, kTiny))));
  }

  /// t = sz (u a.z + v b.z + w c.z) / (u + v + w) may lie in (t_min, t_max], where u, v, w have one sign. The
  /// numerator here and the one that intersect() rounds to t differ by less than 16 roundings of sz |u + v +
  /// w| times the largest |z|: 2 for the edges, 6 for its terms and their sums, 3 for the denominator, 2 for
  /// this comparison, 1 for t. What underflows adds less than 2^-100 sz as long as |z| < 2^40.
  HWY_INLINE hn::Mask<Lanes> distance_may_count(const Edges& e, Floats az, Floats bz, Floats cz,
                                                float t_max) const {
    const Floats sum = hn::Add(hn::Add(e.u, e.v), e.w), weight = hn::Abs(sum);
    const Floats moment = hn::MulAdd(e.u, az, hn::MulAdd(e.v, bz, hn::Mul(e.w, cz)));
    const Floats reach = hn::Max(hn::Max(hn::Abs(az), hn::Abs(bz)), hn::Abs(cz));
    const Floats time = hn::CopySignToAbs(hn::Set(kLanes, 1), sum);
    const Floats along = hn::Mul(hn::Mul(moment, time), hn::Set(kLanes, ray_.sz));
    const float scale = std::abs(ray_.sz);
    const Floats doubt = hn::MulAdd(hn::Mul(reach, weight), hn::Set(kLanes, scale * 0x1p-20f),
                                    hn::Set(kLanes, scale * 0x1p-100f));
    const auto before = hn::Lt(hn::Add(along, doubt), hn::Mul(weight, hn::Set(kLanes, ray_.t_min)));
    const auto behind = hn::Gt(hn::Sub(along, doubt), hn::Mul(weight, hn::Set(kLanes, t_max)));
    return hn::Not(hn::Or(before, behind));
  }

  static Triangle unpack(const float* p, std::size_t size) {
    return {{p[0], p[size], p[2 * size]},
            {p[3 * size], p[4 * size], p[5 * size]},
            {p[6 * size], p[7 * size], p[8 * size]}};
  }

  const ShearedRay& ray_;
  const Floats sx_, sy_, ox_, oy_, oz_;
};

/// Walks through the grid and tests the cells. A hit may lie beyond its cell: it stands only when no later
/// cell can hold a nearer one, which is why the walk's limit is best.t.
template <bool kAny>
bool trace(const GridCells& grid, const WalkedRay& ray, const CellTest& test, Hit& best) {
  for (GridWalk walk(grid, ray, best.t); !walk.done(); walk.step(best.t)) {
    const std::size_t cell = walk.cell();
    const bool crowded = grid.first[cell] == grid.first[cell + 1];
    const bool hit = HWY_UNLIKELY(crowded) ? trace<kAny>(grid.child(cell), ray, test, best)
                                           : test.operator()<kAny>(grid, cell, best);
    if (kAny && hit) return true;
  }
  return false;
}

void closest(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best) {
  trace<false>(grid, WalkedRay(ray), CellTest(sheared), best);
}

bool any(const GridCells& grid, const Ray& ray, const ShearedRay& sheared) {
  Hit best = no_hit(sheared);
  return trace<true>(grid, WalkedRay(ray), CellTest(sheared), best);
}

}  // namespace

GridTrace grid_trace() {
  return {closest, any, hwy::TargetName(HWY_TARGET)};
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
