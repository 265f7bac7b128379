#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "src/core/reflection.h"
#include "src/core/warp.h"
#include "src/lights/sphere_cone.h"

namespace lemma {

/// A whole light as its weight sees it.
struct WholeOutline {
  Vec3 centre{0}, rest{0};  // rounded, and what was rounded off
  float radius2 = 0;        // squared; 0: no light here
  float luminance = 0;
};

namespace detail {

/// exp(x) for x <= 0, to 2 parts in 10^5; the least is 2^-126. Taylor's series of 2^f about 0, |f| <= 1/2.
[[gnu::always_inline, nodiscard]] inline float exp_below_0(float x) {
  // Adding 1.5 2^23 rounds to an integer, which is then found in the lowest bits.
  constexpr float log2_e = 1.44269504f, least = -126, rounds = 0x1.8p23f;
  const float y = x * log2_e > least ? x * log2_e : least;
  const float shifted = y + rounds, f = y - (shifted - rounds);
  float power = 9.6181291e-3f;
  power = power * f + 5.5504109e-2f;
  power = power * f + 2.4022651e-1f;
  power = power * f + 6.9314718e-1f;
  power = power * f + 1;
  return power * std::bit_cast<float>((std::bit_cast<std::uint32_t>(shifted) + 127) << 23);
}

/// 2 pi times the mean of the largest and the smallest cosine with the normal over the cone, 0 below the
/// horizon.
[[gnu::always_inline, nodiscard]] inline float cosines_over_cone(float cos_n, float cos_half,
                                                                 float sin_half) {
  constexpr float slack = 1e-5f;  // cosines err by less
  const float sin_n = std::sqrt(std::max(1 - cos_n * cos_n, 0.0f));
  const float across = cos_n * cos_half, along = sin_n * sin_half;
  const float rim = std::max(across + along + slack, 0.0f);
  return kPi * ((cos_n > cos_half ? 1.0f : rim) + std::max(across - along, 0.0f));
}

[[gnu::always_inline, nodiscard]] inline float reflected_over_cone(const Reflection& r, const Vec3& axis,
                                                                   float one_minus_cos) {
  const Vec3 apart = axis - r.mirror;
  const float narrowing = 1 / (r.width + one_minus_cos);
  const float fallen = exp_below_0(-0.5f * dot(apart, apart) * narrowing);
  return r.peak == 0 ? r.diffuse : r.diffuse + r.peak * r.width * narrowing * fallen;
}

}  // namespace detail

/// Luminance x solid angle of the sphere's cone x about the mean over the cone of max(0, cosine), which is
/// that of its largest and its smallest value, x the mean of what is reflected (Reflection::mean), in
/// float32. Positive if the cone reaches above the horizon, and up to 10^-5 below. -1 where there is no
/// light, or x is so near that the light cannot be sampled as a whole (SphereCone::can_be_sampled, up to
/// rounding). Without branches, for loops over lights or points.
[[gnu::always_inline, nodiscard]] inline float whole_weight(const WholeOutline& light, const Vec3& x,
                                                            const Vec3& n, const Reflection& reflection) {
  constexpr float least = 1e-30f;  // so that nothing that can be seen underflows to 0
  const Vec3 d = (light.centre - x) + light.rest;
  const float distance2 = dot(d, d), radius2 = light.radius2;
  const bool sampled = (radius2 > 0) & (radius2 < distance2 * SphereCone::kLargestSin2);
  const Vec3 axis = d * (1 / std::sqrt(distance2));
  const float sin2 = radius2 / distance2;
  const float cos_half = std::sqrt(std::max(1 - sin2, 0.0f));
  const float one_minus_cos = sin2 / (1 + cos_half);
  const float cosine = detail::cosines_over_cone(dot(n, axis), cos_half, std::sqrt(sin2));
  const float irradiance = light.luminance * one_minus_cos * cosine;
  const float reflects = irradiance * detail::reflected_over_cone(reflection, axis, one_minus_cos);
  const float weight = cosine > 0 ? (reflects > least ? reflects : least) : 0;
  return sampled ? weight : -1;
}

}  // namespace lemma
