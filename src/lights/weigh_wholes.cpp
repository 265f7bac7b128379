#include "src/lights/weigh_wholes.h"

#include "src/core/instruction_sets.h"
#include "src/core/warp.h"
#include "src/lights/sphere_cone.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/lights/weigh_wholes.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, WholeBlock::kSize>;
using Floats = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;
constexpr Lanes kLanes;

// All below works on each lane by itself and fuses no products: so the weights are the same for any number of
// lanes.

struct Vectors {
  Floats x, y, z;
};

HWY_INLINE Floats set(float value) {
  return hn::Set(kLanes, value);
}

HWY_INLINE Vectors broadcast(const Vec3& v) {
  return {set(v.x), set(v.y), set(v.z)};
}

HWY_INLINE Floats dot(const Vectors& a, const Vectors& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// exp(x) for x <= 0, to 2 parts in 10^5; the least is 2^-126. Taylor's series of 2^f about 0, |f| <= 1/2.
HWY_INLINE Floats exp_below_0(Floats x) {
  constexpr float log2_e = 1.44269504f, least = -126;
  constexpr float coefficients[] = {9.6181291e-3f, 5.5504109e-2f, 2.4022651e-1f, 6.9314718e-1f, 1};
  const hn::RebindToSigned<Lanes> ints;
  const Floats y = hn::Max(hn::Mul(x, set(log2_e)), set(least));
  const auto whole = hn::NearestInt(y);
  const Floats f = hn::Sub(y, hn::ConvertTo(kLanes, whole));
  Floats power = hn::Zero(kLanes);
  for (const float c : coefficients) power = hn::Add(hn::Mul(power, f), set(c));
  const auto scale = hn::ShiftLeft<23>(hn::Add(whole, hn::Set(ints, 127)));
  return hn::Mul(power, hn::BitCast(kLanes, scale));
}

/// Weighs the lights of a block from place i on, as many as there are lanes.
class Weigher {
 public:
  HWY_INLINE Weigher(const WholeBlock& block, std::size_t i, const LightQuery& at)
      : block_(block), i_(i), at_(at) {}

  HWY_INLINE Floats operator()() const {
    const Vectors x = broadcast(at_.x);
    const Vectors d{seen(block_.x, block_.rest_x, x.x), seen(block_.y, block_.rest_y, x.y),
                    seen(block_.z, block_.rest_z, x.z)};
    const Floats radius2 = load(block_.radius2), distance2 = dot(d, d);
    const Mask sampled = hn::And(hn::Gt(radius2, hn::Zero(kLanes)),
                                 hn::Lt(radius2, hn::Mul(distance2, set(SphereCone::kLargestSin2))));
    const Floats one = set(1), scale = hn::Div(one, hn::Sqrt(distance2));
    const Vectors axis{hn::Mul(d.x, scale), hn::Mul(d.y, scale), hn::Mul(d.z, scale)};
    const Floats sin2 = hn::Div(radius2, distance2);
    const Floats cos_half = hn::Sqrt(hn::Max(hn::Sub(one, sin2), hn::Zero(kLanes)));
    const Floats one_minus_cos = hn::Div(sin2, hn::Add(one, cos_half));
    const Floats cosine = cosines(axis, cos_half, hn::Sqrt(sin2));
    const Floats irradiance = hn::Mul(hn::Mul(load(block_.luminance), one_minus_cos), cosine);
    const Floats reflects = hn::Max(hn::Mul(irradiance, reflected(axis, one_minus_cos)), set(kLeast));
    const Floats weight = hn::IfThenElseZero(hn::Gt(cosine, hn::Zero(kLanes)), reflects);
    return hn::IfThenElse(sampled, weight, set(-1));
  }

 private:
  // Cosines err by less than this.
  static constexpr float kSlack = 1e-5f;
  // So that nothing that can be seen underflows to 0.
  static constexpr float kLeast = 1e-30f;

  HWY_INLINE Floats load(const WholeBlock::Values& values) const {
    return hn::LoadU(kLanes, values.data() + i_);
  }

  HWY_INLINE Floats seen(const WholeBlock::Values& value, const WholeBlock::Values& rest, Floats from) const {
    return hn::Add(hn::Sub(load(value), from), load(rest));
  }

  /// 2 pi times the mean of the largest and the smallest cosine with the normal over the cone, 0 below the
  /// horizon.
  HWY_INLINE Floats cosines(const Vectors& axis, Floats cos_half, Floats sin_half) const {
    const Floats zero = hn::Zero(kLanes), one = set(1);
    const Floats cos_n = dot(broadcast(at_.n), axis);
    const Floats sin_n = hn::Sqrt(hn::Max(hn::Sub(one, hn::Mul(cos_n, cos_n)), zero));
    const Floats across = hn::Mul(cos_n, cos_half), along = hn::Mul(sin_n, sin_half);
    const Floats rim = hn::Add(hn::Add(across, along), set(kSlack));
    const Floats largest = hn::IfThenElse(hn::Gt(cos_n, cos_half), one, hn::Max(rim, zero));
    return hn::Mul(set(kPi), hn::Add(largest, hn::Max(hn::Sub(across, along), zero)));
  }

  HWY_INLINE Floats reflected(const Vectors& axis, Floats one_minus_cos) const {
    const Reflection& r = at_.reflection;
    const Floats diffuse = set(r.diffuse);
    if (r.peak == 0) return diffuse;
    const Vectors mirror = broadcast(r.mirror);
    const Vectors apart{hn::Sub(axis.x, mirror.x), hn::Sub(axis.y, mirror.y), hn::Sub(axis.z, mirror.z)};
    const Floats narrowing = hn::Div(set(1), hn::Add(set(r.width), one_minus_cos));
    const Floats fallen = exp_below_0(hn::Mul(hn::Mul(set(-0.5f), dot(apart, apart)), narrowing));
    return hn::Add(diffuse, hn::Mul(hn::Mul(set(r.peak * r.width), narrowing), fallen));
  }

  const WholeBlock& block_;
  const std::size_t i_;
  const LightQuery& at_;
};

void weigh(const WholeBlock& block, std::size_t count, const LightQuery& at, WholeBlock::Values& weights) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(kLanes)) {
    hn::StoreU(Weigher(block, i, at)(), kLanes, weights.data() + i);
  }
}

}  // namespace

WeighWholes weigh_wholes() {
  return {weigh, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(weigh_wholes);

const std::vector<WeighWholes>& all_weigh_wholes() {
  static const std::vector<WeighWholes> all =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(weigh_wholes)(); });
  return all;
}

void WholeBlock::set(std::size_t place, const WholeLight& light, float radiance_luminance) {
  const Vec3 centre(light.centre), rest(light.centre - Vec3d(centre));
  x[place] = centre.x, y[place] = centre.y, z[place] = centre.z;
  rest_x[place] = rest.x, rest_y[place] = rest.y, rest_z[place] = rest.z;
  radius2[place] = static_cast<float>(light.radius * light.radius);
  luminance[place] = radiance_luminance;
}

}  // namespace lemma
#endif
