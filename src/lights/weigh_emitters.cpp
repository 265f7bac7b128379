#include "src/lights/weigh_emitters.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "src/core/instruction_sets.h"
#include "src/lights/projected_triangle.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/lights/weigh_emitters.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr std::size_t kMostLanes = 16;
using Lanes = hn::CappedTag<float, kMostLanes>;
using Floats = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;
constexpr Lanes kLanes;

// All below works on each lane by itself and fuses no products: so the weights are the same for any number of
// lanes.

struct Vectors {
  Floats x, y, z;
};

HWY_INLINE Vectors broadcast(const Vec3& v) {
  return {hn::Set(kLanes, v.x), hn::Set(kLanes, v.y), hn::Set(kLanes, v.z)};
}

HWY_INLINE Floats dot(const Vectors& a, const Vectors& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// atan(r) for r in [0, 1], relative error below 2e-7: an odd minimax polynomial, so that 0 stays exact.
HWY_INLINE Floats atan_unit(Floats r) {
  constexpr float coefficients[] = {0.0028662257f, -0.0161657367f, 0.0429096138f, -0.0752896400f,
                                    0.1065626393f, -0.1420889944f, 0.1999355085f, -0.3333314528f};
  const Floats s = hn::Mul(r, r);
  Floats p = hn::Zero(kLanes);
  for (const float c : coefficients) p = hn::Add(hn::Mul(p, s), hn::Set(kLanes, c));
  return hn::Add(r, hn::Mul(hn::Mul(r, s), p));
}

/// atan2(y, x) for y > 0.
HWY_INLINE Floats atan2_upper(Floats y, Floats x) {
  constexpr float pi = 3.14159265358979f;
  const Floats ax = hn::Abs(x);
  const Floats angle = atan_unit(hn::Div(hn::Min(y, ax), hn::Max(y, ax)));
  const Floats acute = hn::IfThenElse(hn::Gt(y, ax), hn::Sub(hn::Set(kLanes, pi / 2), angle), angle);
  return hn::IfThenElse(hn::Lt(x, hn::Zero(kLanes)), hn::Sub(hn::Set(kLanes, pi), acute), acute);
}

/// Calls f(lane) for the lanes of a mask.
template <class F>
HWY_INLINE void for_each_lane(Mask mask, const F& f) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kLanes, mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  for (; bits != 0; bits &= bits - 1) f(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Weighs the emitters of a block from index i on, as many as there are lanes.
template <bool kProjected>
class Weigher {
 public:
  HWY_INLINE Weigher(const EmitterBlock& block, std::size_t i, const Viewpoint& from)
      : block_(block), i_(i), from_(from) {}

  HWY_INLINE Floats operator()() const {
    const Vectors x = broadcast(from_.x);
    const Vectors a = seen(block_.v0_x, block_.v0_y, block_.v0_z, x);
    const Floats luminance = load(block_.luminance);
    const Mask shines = hn::Gt(luminance, hn::Zero(kLanes));
    const Floats side = side_of_planes(a, shines);
    const Mask front = hn::And(shines, hn::Gt(side, hn::Zero(kLanes)));
    if (hn::AllFalse(kLanes, front)) return hn::Zero(kLanes);
    const Vectors b = seen(block_.v1_x, block_.v1_y, block_.v1_z, x);
    const Vectors c = seen(block_.v2_x, block_.v2_y, block_.v2_z, x);
    const Floats la = hn::Sqrt(dot(a, a)), lb = hn::Sqrt(dot(b, b)), lc = hn::Sqrt(dot(c, c));
    // SphericalTriangle::solid_angle()
    const Floats denominator = hn::Add(hn::Add(hn::Mul(hn::Mul(la, lb), lc), hn::Mul(dot(a, b), lc)),
                                       hn::Add(hn::Mul(dot(b, c), la), hn::Mul(dot(c, a), lb)));
    const Floats angle = atan2_upper(hn::Max(side, hn::Set(kLanes, kLeast)), denominator);
    const Floats solid_angle = hn::Max(hn::Add(angle, angle), hn::Set(kLanes, kLeast));
    const Floats measure = kProjected ? projected(solid_angle, front, a, b, c, la, lb, lc) : solid_angle;
    return hn::IfThenElseZero(front, hn::Mul(luminance, measure));
  }

 private:
  // So that nothing that can be seen underflows to 0.
  static constexpr float kLeast = 1e-30f;
  // Triangles that cover more than this are large [sr]: their number is limited by the sphere.
  static constexpr float kLarge = 0.1f;
  // The cosine of a direction errs by less than this.
  static constexpr float kSlack = 1e-6f;

  HWY_INLINE Floats load(const EmitterBlock::Values& values) const {
    return hn::LoadU(kLanes, values.data() + i_);
  }

  HWY_INLINE Vectors seen(const EmitterBlock::Values& x, const EmitterBlock::Values& y,
                          const EmitterBlock::Values& z, const Vectors& from) const {
    return {hn::Sub(load(x), from.x), hn::Sub(load(y), from.y), hn::Sub(load(z), from.z)};
  }

  /// side_of(), of the right sign: where the roundings of float32, one for each of a difference, the normal,
  /// a product and its two sums, may have turned it, it is computed again in double.
  HWY_INLINE Floats side_of_planes(const Vectors& a, Mask shines) const {
    const Vectors normal{load(block_.normal_x), load(block_.normal_y), load(block_.normal_z)};
    const Floats side = hn::Neg(dot(a, normal));
    const Vectors abs_a{hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)},
        abs_normal{hn::Abs(normal.x), hn::Abs(normal.y), hn::Abs(normal.z)};
    const Floats doubt = hn::Mul(dot(abs_a, abs_normal), hn::Set(kLanes, 0x1p-21f));
    const Mask doubtful = hn::And(shines, hn::Le(hn::Abs(side), doubt));
    if (HWY_LIKELY(hn::AllFalse(kLanes, doubtful))) return side;
    HWY_ALIGN float sides[kMostLanes];
    hn::Store(side, kLanes, sides);
    for_each_lane(doubtful, [&](std::size_t lane) {
      const double exact = side_of(block_.triangle(i_ + lane), from_.x);
      sides[lane] = exact > 0 ? std::max(static_cast<float>(exact), kLeast) : 0.0f;
    });
    return hn::Load(kLanes, sides);
  }

  HWY_INLINE Floats projected(Floats solid_angle, Mask front, const Vectors& a, const Vectors& b,
                              const Vectors& c, Floats la, Floats lb, Floats lc) const {
    const Vectors n = broadcast(from_.n);
    const auto cosine = [&](const Vectors& v, Floats length) {
      const Floats above = hn::Add(hn::Div(dot(n, v), length), hn::Set(kLanes, kSlack));
      return hn::Max(above, hn::Zero(kLanes));
    };
    const Floats cosines = hn::Add(hn::Add(cosine(a, la), cosine(b, lb)), cosine(c, lc));
    const Floats estimate = hn::Mul(hn::Mul(cosines, hn::Set(kLanes, 1 / 3.0f)), solid_angle);
    const Mask above = hn::And(front, hn::Gt(cosines, hn::Zero(kLanes)));
    const Mask large = hn::And(above, hn::Gt(solid_angle, hn::Set(kLanes, kLarge)));
    if (HWY_LIKELY(hn::AllFalse(kLanes, large))) return estimate;
    HWY_ALIGN float values[kMostLanes];
    hn::Store(estimate, kLanes, values);
    for_each_lane(large, [&](std::size_t lane) {
      const ProjectedTriangle triangle(block_.triangle(i_ + lane), from_.x, from_.n);
      values[lane] = std::max(static_cast<float>(triangle.projected_solid_angle()), kLeast);
    });
    return hn::Load(kLanes, values);
  }

  const EmitterBlock& block_;
  const std::size_t i_;
  const Viewpoint& from_;
};

template <bool kProjected>
void weigh(const EmitterBlock& block, const Viewpoint& from, EmitterBlock::Values& weights) {
  for (std::size_t i = 0; i < EmitterBlock::kSize; i += hn::Lanes(kLanes)) {
    hn::StoreU(Weigher<kProjected>(block, i, from)(), kLanes, weights.data() + i);
  }
}

}  // namespace

WeighEmitters weigh_emitters() {
  return {weigh<false>, weigh<true>, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(weigh_emitters);

const std::vector<WeighEmitters>& all_weigh_emitters() {
  static const std::vector<WeighEmitters> all =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(weigh_emitters)(); });
  return all;
}

EmitterBlock::EmitterBlock(std::span<const Emitter> emitters) {
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool filler = i >= emitters.size();
    const Emitter& e = filler ? emitters.back() : emitters[i];
    const Triangle& t = e.shape;
    const Vec3 n(area_vector(t));
    v0_x[i] = t.v0.x, v0_y[i] = t.v0.y, v0_z[i] = t.v0.z;
    v1_x[i] = t.v1.x, v1_y[i] = t.v1.y, v1_z[i] = t.v1.z;
    v2_x[i] = t.v2.x, v2_y[i] = t.v2.y, v2_z[i] = t.v2.z;
    normal_x[i] = n.x, normal_y[i] = n.y, normal_z[i] = n.z;
    luminance[i] = filler ? 0 : lemma::luminance(e.radiance);
  }
}

Triangle EmitterBlock::triangle(std::size_t i) const {
  return {{v0_x[i], v0_y[i], v0_z[i]}, {v1_x[i], v1_y[i], v1_z[i]}, {v2_x[i], v2_y[i], v2_z[i]}};
}

}  // namespace lemma
#endif
