// Included once for every instruction set that accel/grid_trace.cpp is compiled for.
#if defined(LEMMA_GRID_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LEMMA_GRID_BLOCKS_INL_H
#undef LEMMA_GRID_BLOCKS_INL_H
#else
#define LEMMA_GRID_BLOCKS_INL_H
#endif

#include <bit>
#include <type_traits>

#include "accel/grid_lanes-inl.h"
#include "accel/watertight.h"

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// b.x c.y - b.y c.x, of the right sign or, in doubt, 0. Where products are fused the second line adds what
/// the first lost to the rounding of b.y c.x: the sum is 0 only if the value is, and else has its sign.
/// Source: Jeannerod, Louvet, Muller, Further Analysis of Kahan's Algorithm for the Accurate Computation of 2
/// x 2 Determinants, Mathematics of Computation 82, 2013. Elsewhere the three roundings err by less than
/// 2^-23 of the products, and what is not twice as large counts as 0.
template <class Floats>
HWY_INLINE Floats edge(Floats bx, Floats by, Floats cx, Floats cy) {
  const Floats lost = hn::Mul(by, cx);
#if HWY_NATIVE_FMA
  return hn::Add(hn::MulSub(bx, cy, lost), hn::NegMulAdd(by, cx, lost));
#else
  const Floats kept = hn::Mul(bx, cy), value = hn::Sub(kept, lost);
  const Floats doubt =
      hn::Mul(hn::Add(hn::Abs(kept), hn::Abs(lost)), hn::Set(hn::DFromV<Floats>(), 0x1p-22f));
  return hn::IfThenZeroElse(hn::Le(hn::Abs(value), doubt), value);
#endif
}

/// Products that underflow lose less than 2^-147 in edge(): beyond this its sign is right all the same.
constexpr float kTiny = 0x1p-126f;

/// Whether the values of edge() are precise too, to 2 roundings, and not their signs alone.
constexpr bool kPreciseEdges = HWY_NATIVE_FMA != 0;

/// shear() of accel/watertight.h for as many vertices as there are lanes, rounding for rounding.
template <class Lanes>
class Shear {
 public:
  using Floats = hn::Vec<Lanes>;
  struct Vertices {
    Floats x, y, z;
  };

  HWY_INLINE explicit Shear(const ShearedRay& ray)
      : ray_(ray),
        sx_(hn::Set(kLanes, ray.sx)),
        sy_(hn::Set(kLanes, ray.sy)),
        ox_(hn::Set(kLanes, ray.origin[ray.kx])),
        oy_(hn::Set(kLanes, ray.origin[ray.ky])),
        oz_(hn::Set(kLanes, ray.origin[ray.kz])) {}

  /// @param size  distance between the arrays of packed coordinates
  HWY_INLINE Vertices operator()(const float* vertex, std::size_t size) const {
    const auto k = [&](int axis) {
      return hn::LoadU(kLanes, vertex + static_cast<std::size_t>(axis) * size);
    };
    const Floats z = hn::Sub(k(ray_.kz), oz_);
    return {hn::Sub(hn::Sub(k(ray_.kx), ox_), hn::Mul(sx_, z)),
            hn::Sub(hn::Sub(k(ray_.ky), oy_), hn::Mul(sy_, z)), z};
  }

 private:
  static constexpr Lanes kLanes{};
  const ShearedRay& ray_;
  const Floats sx_, sy_, ox_, oy_, oz_;
};

/// Tests up to kWidth triangles of a list at a time: what it cannot rule out, the test of one triangle
/// decides, unless any hit will do and it is sure of one.
template <bool kAny, std::size_t kWidth>
class BlockTest {
 public:
  using Lanes = hn::CappedTag<float, kWidth>;
  static constexpr Lanes kLanes{};

  HWY_INLINE explicit BlockTest(const ShearedRay& ray) : ray_(ray), shear_(ray) {}

  /// intersect() with the triangles of a part of a list (GridCells::packed), up to a hit if any will do.
  HWY_INLINE bool operator()(const float* packed, const std::uint32_t* triangles, std::size_t size,
                             Hit& best) const {
    bool hit = false;
    for (std::size_t i = 0; i < size; i += hn::Lanes(kLanes)) {
      const auto [may_hit, hits] = find(packed + i, size, size - i, best.t);
      if (hits) return true;
      for (std::uint64_t rest = may_hit; rest != 0; rest &= rest - 1) {
        const std::size_t j = i + static_cast<std::size_t>(std::countr_zero(rest));
        if (triangles[j] == best.triangle && best.t < ray_.t_max) continue;  // hit before
        const float* triangle = packed + j;
        hit |= intersect(ray_, shear(triangle, size), shear(triangle + 3 * size, size),
                         shear(triangle + 6 * size, size), triangles[j], best);
        if (kAny && hit) return true;
      }
    }
    return hit;
  }

 private:
  using Floats = hn::Vec<Lanes>;
  struct Edges {
    Floats u, v, w;
  };
  struct Found {
    std::uint64_t may_hit;  // bit i is set if the ray may hit triangle i at a t up to `t_max`
    bool hits;              // it surely hits one of them before; never set unless kAny
  };
  /// @param count  triangles to test: the first of the lanes
  /// @param size   distance between the arrays of packed vertices
  HWY_INLINE Found find(const float* packed, std::size_t size, std::size_t count, float t_max) const {
    const auto a = shear_(packed, size), b = shear_(packed + 3 * size, size),
               c = shear_(packed + 6 * size, size);
    const Edges e{edge(c.x, c.y, b.x, b.y), edge(a.x, a.y, c.x, c.y), edge(b.x, b.y, a.x, a.y)};
    auto may_hit = hn::And(line_may_pass(e), hn::FirstN(kLanes, count));
    if (HWY_LIKELY(hn::AllFalse(kLanes, may_hit))) return {0, false};
    bool hits = false;
    if constexpr (kPreciseEdges) {
      const Distance t = distance(e, a.z, b.z, c.z, t_max);
      if constexpr (kAny) hits = !hn::AllFalse(kLanes, hn::And(hn::And(may_hit, line_passes(e)), t.inside()));
      may_hit = hn::AndNot(t.outside(), may_hit);
    }
    return {bits_of(kLanes, may_hit), hits};
  }

  /// A vertex of a packed triangle: shear() of accel/watertight.h, rounding for rounding.
  [[nodiscard]] HWY_INLINE watertight::Vertex shear(const float* vertex, std::size_t size) const {
    const auto k = [&](int axis) {
      return vertex[static_cast<std::size_t>(axis) * size] - ray_.origin[axis];
    };
    const float z = k(ray_.kz);
    return {k(ray_.kx) - ray_.sx * z, k(ray_.ky) - ray_.sy * z, z};
  }

  /// No two edge functions have opposite signs. Not a number compares as false and so rules out nothing.
  static HWY_INLINE hn::Mask<Lanes> line_may_pass(const Edges& e) {
    const Floats least = hn::Min(hn::Min(e.u, e.v), e.w), most = hn::Max(hn::Max(e.u, e.v), e.w);
    return hn::Not(hn::And(hn::Lt(least, hn::Set(kLanes, -kTiny)), hn::Gt(most, hn::Set(kLanes, kTiny))));
  }

  /// All edge functions have one sign, so that those of intersect(), which are exact, have it too.
  static HWY_INLINE hn::Mask<Lanes> line_passes(const Edges& e) {
    const Floats least = hn::Min(hn::Min(e.u, e.v), e.w), most = hn::Max(hn::Max(e.u, e.v), e.w);
    return hn::Or(hn::Gt(least, hn::Set(kLanes, kTiny)), hn::Lt(most, hn::Set(kLanes, -kTiny)));
  }

  /// t |u + v + w| lies in [first, last], and the ray's range in [near, far]. Not a number is neither inside
  /// nor outside.
  struct Distance {
    Floats first, last, near, far;

    HWY_INLINE hn::Mask<Lanes> outside() const { return hn::Or(hn::Lt(last, near), hn::Gt(first, far)); }
    HWY_INLINE hn::Mask<Lanes> inside() const { return hn::And(hn::Gt(first, near), hn::Lt(last, far)); }
  };

  /// t = sz (u a.z + v b.z + w c.z) / (u + v + w) against (t_min, t_max], where u, v, w have one sign. The
  /// numerator here and the one that intersect() rounds to t differ by less than 16 roundings of sz |u + v +
  /// w| times the largest |z|: 2 for the edges, 6 for its terms and their sums, 3 for the denominator, 2 for
  /// this comparison, 1 for t. What underflows adds less than 2^-100 sz as long as |z| < 2^40.
  HWY_INLINE Distance distance(const Edges& e, Floats az, Floats bz, Floats cz, float t_max) const {
    const Floats sum = hn::Add(hn::Add(e.u, e.v), e.w), weight = hn::Abs(sum);
    const Floats moment = hn::MulAdd(e.u, az, hn::MulAdd(e.v, bz, hn::Mul(e.w, cz)));
    const Floats reach = hn::Max(hn::Max(hn::Abs(az), hn::Abs(bz)), hn::Abs(cz));
    const Floats time = hn::CopySignToAbs(hn::Set(kLanes, 1), sum);
    const Floats along = hn::Mul(hn::Mul(moment, time), hn::Set(kLanes, ray_.sz));
    const float scale = std::abs(ray_.sz);
    const Floats doubt = hn::MulAdd(hn::Mul(reach, weight), hn::Set(kLanes, scale * 0x1p-20f),
                                    hn::Set(kLanes, scale * 0x1p-100f));
    return {hn::Sub(along, doubt), hn::Add(along, doubt), hn::Mul(weight, hn::Set(kLanes, ray_.t_min)),
            hn::Mul(weight, hn::Set(kLanes, t_max))};
  }

  const ShearedRay& ray_;
  const Shear<Lanes> shear_;
};

#if HWY_MAX_BYTES >= 64
/// intersect() with eight triangles of a list at a time, rounding for rounding: where one vector holds their
/// double precision, this takes less time until its answer than BlockTest and then intersect().
class ExactTest {
 public:
  HWY_INLINE explicit ExactTest(const ShearedRay& ray) : ray_(ray), shear_(ray) {}

  /// intersect() with the triangles of a part of a list (GridCells::packed).
  HWY_INLINE bool operator()(const float* packed, const std::uint32_t* triangles, std::size_t size,
                             Hit& best) const {
    bool hit = false;
    for (std::size_t i = 0; i < size; i += hn::Lanes(f))
      hit |= find(packed + i, triangles + i, size, size - i, best);
    return hit;
  }

 private:
  HWY_INLINE bool find(const float* packed, const std::uint32_t* triangles, std::size_t size,
                       std::size_t count, Hit& best) const {
    const auto a = shear_(packed, size), b = shear_(packed + 3 * size, size),
               c = shear_(packed + 6 * size, size);
    const Doubles u = edge(c, b), v = edge(a, c), w = edge(b, a), sum = hn::Add(hn::Add(u, v), w);
    const Doubles least = hn::Min(hn::Min(u, v), w), most = hn::Max(hn::Max(u, v), w), zero = hn::Zero(d);
    const auto outside = hn::Or(hn::And(hn::Lt(least, zero), hn::Gt(most, zero)), hn::Eq(sum, zero));
    const auto z = [](Floats x) { return hn::PromoteTo(d, x); };
    const Doubles moment = hn::Add(hn::Add(hn::Mul(u, z(a.z)), hn::Mul(v, z(b.z))), hn::Mul(w, z(c.z)));
    const Floats t = hn::DemoteTo(f, hn::Div(hn::Mul(hn::Set(d, ray_.sz), moment), sum));
    const auto in_range = hn::And(hn::Gt(t, hn::Set(f, ray_.t_min)), hn::Le(t, hn::Set(f, best.t)));
    std::uint64_t rest = bits_of(f, hn::And(in_range, hn::FirstN(f, count))) & ~bits_of(d, outside);
    if (rest == 0) return false;
    alignas(64) float ts[8];
    alignas(64) double vs[8], ws[8], sums[8];
    hn::Store(t, f, ts);
    hn::Store(v, d, vs);
    hn::Store(w, d, ws);
    hn::Store(sum, d, sums);
    bool hit = false;
    for (; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(rest));
      if (!(ts[i] < best.t || (ts[i] == best.t && triangles[i] < best.triangle))) continue;
      best = {ts[i], triangles[i], static_cast<float>(vs[i] / sums[i]), static_cast<float>(ws[i] / sums[i])};
      hit = true;
    }
    return hit;
  }

  static constexpr hn::FixedTag<float, 8> f{};
  static constexpr hn::FixedTag<double, 8> d{};
  using Floats = hn::Vec<hn::FixedTag<float, 8>>;
  using Doubles = hn::Vec<hn::FixedTag<double, 8>>;
  using Vertices = Shear<hn::FixedTag<float, 8>>::Vertices;

  static HWY_INLINE Doubles edge(const Vertices& b, const Vertices& c) {
    const auto product = [](Floats x, Floats y) { return hn::Mul(hn::PromoteTo(d, x), hn::PromoteTo(d, y)); };
    return hn::Sub(product(b.x, c.y), product(b.y, c.x));
  }

  const ShearedRay& ray_;
  const Shear<hn::FixedTag<float, 8>> shear_;
};
#endif

/// The test of up to eight triangles that takes the least time until its answer.
#if HWY_MAX_BYTES >= 64
template <bool kAny>
using FewTest = std::conditional_t<kAny, BlockTest<true, 8>, ExactTest>;
#else
template <bool kAny>
using FewTest = BlockTest<kAny, 8>;
#endif

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#endif
