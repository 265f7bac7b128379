#include "accel/grid_trace.h"

#include <array>
#include <bit>

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

/// Bit i of a mask's lanes, of which there are at most 16.
template <class D, class M>
HWY_INLINE std::uint64_t bits_of(D d, M mask) {
  std::uint8_t bytes[8];
  hn::StoreMaskBits(d, mask, bytes);
  return hn::Lanes(d) > 8 ? bytes[0] | std::uint64_t{bytes[1]} << 8 : bytes[0];
}

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

/// Tests up to kWidth triangles of a list at a time: what it cannot rule out, the test of one triangle
/// decides, unless any hit will do and it is sure of one.
template <bool kAny, std::size_t kWidth>
class BlockTest {
 public:
  using Lanes = hn::CappedTag<float, kWidth>;
  static constexpr Lanes kLanes{};

  HWY_INLINE explicit BlockTest(const ShearedRay& ray)
      : ray_(ray),
        sx_(hn::Set(kLanes, ray.sx)),
        sy_(hn::Set(kLanes, ray.sy)),
        ox_(hn::Set(kLanes, ray.origin[ray.kx])),
        oy_(hn::Set(kLanes, ray.origin[ray.ky])),
        oz_(hn::Set(kLanes, ray.origin[ray.kz])) {}

  struct Found {
    std::uint64_t may_hit;  // bit i is set if the ray may hit triangle i at a t up to `t_max`
    bool hits;              // it surely hits one of them before; never set unless kAny
  };
  /// @param count  triangles to test: the first of the lanes
  /// @param size   distance between the arrays of packed vertices
  HWY_INLINE Found find(const float* packed, std::size_t size, std::size_t count, float t_max) const {
    const Vertices a = shear(packed, size), b = shear(packed + 3 * size, size),
                   c = shear(packed + 6 * size, size);
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

 private:
  using Floats = hn::Vec<Lanes>;
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
  const Floats sx_, sy_, ox_, oy_, oz_;
};

/// Whether a ray may pass the box of a record within its range. Source: Kay, Kajiya, Ray Tracing Complex
/// Scenes, SIGGRAPH 1986. Slabs err by 3 roundings of the distance between the ray's origin and the box: the
/// box is wider by more (fit_boxes). Where a ray in the plane of a slab makes 0 times infinity, that width
/// is what lies between it and all triangles, and either answer is right.
#if HWY_TARGET == HWY_SCALAR
class BoxTest {
 public:
  explicit BoxTest(const Ray& ray) : origin_(ray.origin), pace_(Vec3(1) / ray.direction), t_min_(ray.t_min) {}

  bool may_pass(const GridCells::Record& cell, float t_max) const {
    const Vec3 a = (cell.lo - origin_) * pace_, b = (cell.hi - origin_) * pace_;
    float enter = t_min_, leave = t_max;
    for (int k = 0; k < 3; ++k) {
      enter = std::max(enter, std::min(a[k], b[k]));
      leave = std::min(leave, std::max(a[k], b[k]));
    }
    return !(enter > leave);
  }

 private:
  const Vec3 origin_, pace_;
  const float t_min_;
};
#else
class BoxTest {
 public:
  HWY_INLINE explicit BoxTest(const Ray& ray)
      : origin_(load(ray.origin)), pace_(hn::Div(hn::Set(d, 1), load(ray.direction))), t_min_(ray.t_min) {}

  HWY_INLINE bool may_pass(const GridCells::Record& cell, float t_max) const {
    const Floats a = hn::Mul(hn::Sub(hn::Load(d, &cell.lo.x), origin_), pace_);
    const Floats b = hn::Mul(hn::Sub(hn::Load(d, &cell.hi.x), origin_), pace_);
    const auto axes = hn::FirstN(d, 3);
    const Floats enter = hn::IfThenElse(axes, hn::Min(a, b), hn::Set(d, t_min_));
    Floats leave = hn::IfThenElse(axes, hn::Max(a, b), hn::Set(d, t_max));
    leave = hn::Min(leave, hn::Shuffle1032(leave));
    leave = hn::Min(leave, hn::Shuffle2301(leave));
    return hn::AllFalse(d, hn::Gt(enter, leave));
  }

 private:
  using D = hn::FixedTag<float, 4>;
  using Floats = hn::Vec<D>;
  static constexpr D d{};
  static HWY_INLINE Floats load(const Vec3& v) {
    alignas(16) const float lanes[4] = {v.x, v.y, v.z, 1};
    return hn::Load(d, lanes);
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

/// Tests the triangles of cells, many at a time: hits are those of brute force to the bit.
template <bool kAny>
class CellTest {
 public:
  HWY_INLINE CellTest(const Ray& ray, const ShearedRay& sheared)
      : ray_(sheared), parts_(ray), few_(sheared), many_(sheared) {}

  /// intersect() with the triangles of the cell's list.
  HWY_INLINE bool operator()(const GridCells& grid, const GridCells::Record& list, Hit& best) const {
    if (list.count <= 8) return test(few_, grid, list.begin, list.count, best);
    bool hit = false;
    if (list.count <= GridCells::kFew) {
      for (std::size_t i = 0; i < list.count; i += GridCells::kPart) {
        hit |= test(many_, grid, list.begin + i, std::min(GridCells::kPart, list.count - i), best);
        if (kAny && hit) return true;
      }
      return hit;
    }
    const std::size_t parts = GridCells::part_count(list.count);
    const float* boxes = grid.part_boxes(list);
    for (std::size_t first = 0; first < parts; first += parts_.lanes()) {
      for (std::uint64_t rest = parts_.may_pass(boxes + first, parts, parts - first, best.t); rest != 0;
           rest &= rest - 1) {
        const std::size_t i = GridCells::kPart * (first + static_cast<std::size_t>(std::countr_zero(rest)));
        hit |= test(many_, grid, list.begin + i, std::min(GridCells::kPart, list.count - i), best);
        if (kAny && hit) return true;
      }
    }
    return hit;
  }

 private:
  template <class Block>
  HWY_INLINE bool test(const Block& block, const GridCells& grid, std::size_t begin, std::size_t size,
                       Hit& best) const {
    const float* packed = grid.packed(begin);
    const std::uint32_t* triangles = grid.references.data() + begin;
    bool hit = false;
    for (std::size_t i = 0; i < size; i += hn::Lanes(block.kLanes)) {
      const auto [may_hit, hits] = block.find(packed + i, size, size - i, best.t);
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

  /// A vertex of a packed triangle: shear() of accel/watertight.h, rounding for rounding.
  [[nodiscard]] HWY_INLINE watertight::Vertex shear(const float* vertex, std::size_t size) const {
    const auto k = [&](int axis) {
      return vertex[static_cast<std::size_t>(axis) * size] - ray_.origin[axis];
    };
    const float z = k(ray_.kz);
    return {k(ray_.kx) - ray_.sx * z, k(ray_.ky) - ray_.sy * z, z};
  }

  const ShearedRay& ray_;
  const PartTest parts_;
  const BlockTest<kAny, 8> few_;
  const BlockTest<kAny, GridCells::kOverread> many_;
};

/// As many slices of a grid at a time as there are lanes: a 3D DDA in parallel. In each slice the ray passes
/// one to three cells. Source: Amanatides, Woo, A Fast Voxel Traversal Algorithm for Ray Tracing,
/// Eurographics 1987; by slices after Wald, Ize, Kensler, Knoll, Parker, Ray Tracing Animated Scenes using
/// Coherent Grid Traversal, ACM TOG 25(3), 2006, where they cut packets of rays.
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

  /// Finds the occupied cells of the slices from `first` on that the ray enters at s <= reach.
  HWY_INLINE Slices(const GridCells::Word* occupied, const GridCrossing& ray, int first, float reach) {
    const Ints number = hn::Add(hn::Iota(n, 0), hn::Set(n, first));
    const Floats leave = hn::Add(hn::ConvertTo(f, number), hn::Set(f, ray.to_plane));
    const Floats enter = hn::Max(hn::Sub(leave, hn::Set(f, 1)), hn::Zero(f));
    const Ints slice = hn::Add(hn::Mul(number, hn::Set(n, ray.step)), hn::Set(n, ray.slice));
    const auto inside = hn::And(hn::Le(enter, hn::Set(f, reach)),
                                hn::RebindMask(f, hn::Eq(slice, clamp(slice, ray.count - 1))));
    const Part u = part(ray.side[0], enter, leave), v = part(ray.side[1], enter, leave);
    const Ints a = hn::Add(hn::Mul(slice, hn::Set(n, ray.stride)), hn::Add(u.index, v.index));
    const Ints b = hn::Add(a, hn::Add(u.turn, v.turn));
    const auto u_first = hn::Lt(u.s, v.s);
    const Ints m = hn::Add(a, hn::IfThenElse(hn::RebindMask(n, u_first), u.turn, v.turn));
    const auto u_turns = hn::RebindMask(f, hn::Ne(u.turn, hn::Zero(n)));
    const auto v_turns = hn::RebindMask(f, hn::Ne(v.turn, hn::Zero(n)));
    const auto both = hn::And(u_turns, v_turns);
    const Floats soon = hn::IfThenElse(u_first, u.s, v.s), late = hn::IfThenElse(u_first, v.s, u.s);
    const Floats turn = hn::IfThenElse(both, late, hn::IfThenElse(u_turns, u.s, v.s));
    const int* words = reinterpret_cast<const int*>(occupied);
    bits_ = keep(0, a, enter, inside, words);
    bits_ |= keep(1, m, soon, hn::And(inside, both), words) << 1;
    bits_ |= keep(2, b, turn, hn::And(inside, hn::Or(u_turns, v_turns)), words) << 2;
  }

  [[nodiscard]] HWY_INLINE bool done() const { return bits_ == 0; }
  HWY_INLINE void next() { bits_ &= bits_ - 1; }
  [[nodiscard]] HWY_INLINE std::uint32_t cell() const { return static_cast<std::uint32_t>(cells_[place()]); }
  /// s at which the ray enters the cell.
  [[nodiscard]] HWY_INLINE float enter() const { return enter_[place()]; }

 private:
  /// The ray's way on a side axis in each slice: its part of the cells' index, the index's change where it
  /// goes to the next cell and else 0, and the s at which it does.
  struct Part {
    Ints index, turn;
    Floats s;
  };

  static HWY_INLINE Ints clamp(Ints x, int last) {
    return hn::Min(hn::Max(x, hn::Zero(n)), hn::Set(n, last));
  }

  static HWY_INLINE Part part(const GridCrossing::Side& side, Floats enter, Floats leave) {
    const Floats start = hn::Set(f, side.start), slope = hn::Set(f, side.slope);
    const auto place = [&](Floats s) {
      return clamp(hn::ConvertTo(n, hn::Add(hn::Mul(s, slope), start)), side.last);
    };
    const Ints from = place(enter), to = place(leave);
    const bool up = side.slope > 0;
    const Floats plane = hn::ConvertTo(f, hn::Add(from, hn::Set(n, up ? 1 : 0)));
    const Ints turn = hn::IfThenZeroElse(hn::Eq(from, to), hn::Set(n, up ? side.stride : -side.stride));
    return {hn::Mul(from, hn::Set(n, side.stride)), turn,
            hn::Mul(hn::Sub(plane, start), hn::Set(f, side.pace))};
  }

  /// Bit 4 i is set if cell i is of interest and occupied.
  HWY_INLINE std::uint64_t keep(std::size_t order, Ints cell, Floats enter, hn::Mask<F> wanted,
                                const int* words) {
    hn::Store(cell, n, cells_ + 16 * order);
    hn::Store(enter, f, enter_ + 16 * order);
    const Ints index = hn::IfThenElseZero(hn::RebindMask(n, wanted), cell);
    const Ints word = hn::GatherIndex(n, words, hn::ShiftLeft<1>(hn::ShiftRight<5>(index)));
    const Ints bit = hn::Shl(hn::Set(n, 1), hn::And(index, hn::Set(n, 31)));
    const auto occupied = hn::And(hn::TestBit(word, bit), hn::RebindMask(n, wanted));
    std::uint64_t bits = bits_of(n, occupied);
    bits = (bits | bits << 24) & 0x000000FF000000FF;
    bits = (bits | bits << 12) & 0x000F000F000F000F;
    bits = (bits | bits << 6) & 0x0303030303030303;
    return (bits | bits << 3) & 0x1111111111111111;
  }

  [[nodiscard]] HWY_INLINE std::size_t place() const {
    const auto bit = static_cast<std::size_t>(std::countr_zero(bits_));
    return 16 * (bit % 4) + bit / 4;
  }

  alignas(64) int cells_[kMostCells];
  alignas(64) float enter_[kMostCells];
  std::uint64_t bits_;
};

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
 public:
  HWY_INLINE Walk(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best)
      : grid_(grid), ray_(ray), test_(ray, sheared), box_(ray), best_(best) {}

  /// Through one level and those of its cells; says whether there is a hit, if any will do.
  bool through(const GridLevel& level) {
    const GridCrossing crossing(level, ray_, best_.t);
    if (crossing.misses) return false;
    bool hit = false;
    float reach = crossing.end;
    for (int first = 0; first < crossing.count && crossing.begins(first) <= reach; first += Slices::lanes()) {
      Slices slices(grid_.occupied.data() + level.words, crossing, first, reach);
      if constexpr (kAny) {
        if (hits_any(level, slices)) return true;
      } else {
        for (; !slices.done() && slices.enter() <= reach; slices.next()) {
          const GridCells::Record& cell = grid_.record(level, slices.cell());
          if (!box_.may_pass(cell, best_.t) || !visit(cell)) continue;
          hit = true;
          reach = crossing.reach(best_.t);
        }
      }
    }
    return hit;
  }

 private:
  /// Tests the boxes of all cells first: which rays pass is hard to predict, and most such rays get to the
  /// last cell. The closest hit is in one of the first.
  HWY_INLINE bool hits_any(const GridLevel& level, Slices& slices) {
    std::array<const GridCells::Record*, Slices::kMostCells> passed;
    std::size_t count = 0;
    for (; !slices.done(); slices.next()) {
      const GridCells::Record& cell = grid_.record(level, slices.cell());
      passed[count] = &cell;
      count += box_.may_pass(cell, best_.t) ? 1 : 0;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (visit(*passed[i])) return true;
    }
    return false;
  }

  HWY_INLINE bool visit(const GridCells::Record& cell) {
    if (cell.count == GridCells::Record::kLevel) return through(grid_.levels[cell.begin]);
    return tested_.is_new(cell.begin) && test_(grid_, cell, best_);
  }

  const GridCells& grid_;
  const Ray& ray_;
  const CellTest<kAny> test_;
  const BoxTest box_;
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
  if (crossing.misses) return;
  for (int first = 0; crossing.begins(first) <= crossing.end && first < crossing.count;
       first += Slices::lanes()) {
    for (Slices slices(grid.occupied.data() + level.words, crossing, first, crossing.end); !slices.done();
         slices.next())
      cells.push_back(slices.cell());
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
