#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "src/core/elementary.h"
#include "src/core/vec.h"
#include "src/core/warp.h"

namespace lemma {

// What loops over lanes call as well is free of calls, and inlined whatever its size: else there is no vector
// code.

/// condition ? a : b, by components: GCC leaves a structure that a condition chooses in memory, which no
/// vector code is made of.
[[gnu::always_inline, nodiscard]] inline Vec3 select(bool condition, const Vec3& a, const Vec3& b) {
  return {condition ? a.x : b.x, condition ? a.y : b.y, condition ? a.z : b.z};
}

/// value where the condition holds, else 0. By the bits: were it a choice, GCC would find all that follows
/// from the 0 apart.
[[gnu::always_inline, nodiscard]] inline float where(bool condition, float value) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & (0 - std::uint32_t{condition}));
}
[[gnu::always_inline, nodiscard]] inline double where(bool condition, double value) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & (0 - std::uint64_t{condition}));
}

/// (1 - x)^n for x = 1 - cos(alpha): the lobe cos^n(alpha) of 90 degrees and less, 0 beyond. By log1p,
/// because pow(cos(alpha), n) loses all digits at n = 1e5. Taken for 0 below exp(-80) = 1.8e-35: near 1e-38
/// floats lose digits, and processors their speed.
[[gnu::always_inline, nodiscard]] inline float cos_power(float one_minus_cos, float n) {
  const bool is_above = one_minus_cos < 1;
  const double exponent = n * elementary::log1p(-double{where(is_above, one_minus_cos)});
  return static_cast<float>(where(is_above & (exponent > -80), elementary::exp(exponent)));
}

/// 1 - cos(alpha) with density (n + 1) / (2 pi) cos(alpha)^n over the hemisphere: 1 - (1 - u)^(1 / (n + 1)),
/// by expm1 so that narrow lobes keep their digits.
/// @param u  uniform in [0, 1)
[[gnu::always_inline, nodiscard]] inline float sample_one_minus_cos(float n, float u) {
  return static_cast<float>(-elementary::expm1(elementary::log1p(-double{u}) / (double{n} + 1)));
}

/// 1 - cos of the angle between unit vectors: |a - b|^2 / 2, which does not cancel.
[[nodiscard]] inline float one_minus_cos_between(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return 0.5f * dot(d, d);
}

/// sin(alpha) from 1 - cos(alpha) in [0, 1].
[[nodiscard]] inline float sine(float one_minus_cos) {
  return std::sqrt(one_minus_cos * (2 - one_minus_cos));
}

// A lobe has, for directions in the local frame whose z axis is the normal, wo above the surface:
//   cos_n(wi)       its value without a factor
//   pdf(wi, cos_n)  the density of sample(), wi above the surface, cos_n of the same wi [sr^-1]
//   sample(u)       a unit direction, above the surface or not, from u uniform in [0, 1)^2

/// The Phong lobe about the mirror direction r. With Truncated only its part above the horizon is drawn: a
/// direction at the angle alpha from r and the azimuth phi, counted from the side of the normal, has
///   z = cos(theta_r) cos(alpha) + sin(theta_r) sin(alpha) cos(phi),
/// so that the azimuths up to some phi_m >= pi / 2 lie above the surface. They are drawn uniformly: alpha
/// keeps its distribution, the density grows by pi / phi_m <= 2, no weight grows, and no sample is lost.
template <bool Truncated>
class PhongLobe {
 public:
  PhongLobe(const Vec3& wo, float n) : r_(-wo.x, -wo.y, wo.z), n_(n) {}

  [[gnu::always_inline, nodiscard]] float cos_n(const Vec3& wi) const {
    return cos_power(one_minus_cos_between(wi, r_), n_);
  }

  [[gnu::always_inline, nodiscard]] float pdf(const Vec3& wi, float cos_n) const {
    return (n_ + 1) * 0.5f * cos_n / largest_azimuth(std::min(one_minus_cos_between(wi, r_), 1.0f));
  }

  [[gnu::always_inline, nodiscard]] Vec3 sample(const Vec2& u) const {
    const float x = sample_one_minus_cos(n_, u.x);
    const auto [sin_phi, cos_phi] = sin_cos_turn((u.y - 0.5f) * kInvPi * largest_azimuth(x));
    const float sin_r = sin_of_r();
    const Vec3 towards_normal =
        select(sin_r > 0, Vec3(-r_.x * r_.z / sin_r, -r_.y * r_.z / sin_r, sin_r), Vec3(1, 0, 0));
    const Vec3 side = cross(r_, towards_normal);
    return r_ * (1 - x) + (towards_normal * cos_phi + side * sin_phi) * sine(x);
  }

 private:
  [[nodiscard]] float sin_of_r() const { return std::sqrt(r_.x * r_.x + r_.y * r_.y); }

  /// @param one_minus_cos  of alpha, at most 1
  [[gnu::always_inline, nodiscard]] float largest_azimuth(float one_minus_cos) const {
    if constexpr (!Truncated) return kPi;
    const float across = sin_of_r() * sine(one_minus_cos), along = r_.z * (1 - one_minus_cos);
    // acos(-along / across), all around where along is greater.
    const float quotient = along / std::max(std::max(along, across), std::numeric_limits<float>::min());
    return 0.5f * kPi + elementary::asin_in_single(quotient);
  }

  Vec3 r_;
  float n_;
};

/// Blinn's lobe: the half vector h by the cosine's power about the normal; 1 / (4 |wo . h|) turns its density
/// into that of wi (Torrance and Sparrow, Theory for Off-Specular Reflection, 1967).
class BlinnLobe {
 public:
  BlinnLobe(const Vec3& wo, float n) : wo_(wo), n_(n) {}

  [[gnu::always_inline, nodiscard]] float cos_n(const Vec3& wi) const {
    const Vec3 sum = wo_ + wi;
    const float one_minus_cos = one_minus_cos_between({0, 0, 1}, normalize(sum));
    return where(has_direction(sum), cos_power(one_minus_cos, n_));
  }

  [[gnu::always_inline, nodiscard]] float pdf(const Vec3& wi, float cos_n) const {
    const float sum = std::max(length(wo_ + wi), kLeastSum);  // twice wo . h
    return (n_ + 1) * (0.5f * kInvPi) * cos_n / (2 * sum);
  }

  [[gnu::always_inline, nodiscard]] Vec3 sample(const Vec2& u) const {
    const float x = sample_one_minus_cos(n_, u.x);
    const auto [sin_phi, cos_phi] = sin_cos_turn(u.y);
    const float sin_h = sine(x);
    const Vec3 h(sin_h * cos_phi, sin_h * sin_phi, 1 - x);
    return normalize(h * (2 * dot(wo_, h)) - wo_);
  }

 private:
  /// The half vector of opposed directions along the surface is what rounding leaves; its square may be 0.
  static bool has_direction(const Vec3& sum) { return dot(sum, sum) > kLeastSum * kLeastSum; }
  static constexpr float kLeastSum = 0x1p-63f;

  Vec3 wo_;
  float n_;
};

}  // namespace lemma
