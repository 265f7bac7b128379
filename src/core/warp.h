#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "src/core/vec.h"

namespace lemma {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;

template <class T>
struct SinCos {
  T sin, cos;
};

/// Sine and cosine of 2 pi u for u in [-1, 1]: of the angle to the nearest quarter turn by Taylor's series,
/// whose rest is below 2e-9 for float and 5e-17 for double, then exactly turned by those quarters.
template <class T>
[[nodiscard]] inline SinCos<T> sin_cos_turn(T u) {
  constexpr bool fine = std::is_same_v<T, double>;
  const int quarters = static_cast<int>(4 * u + std::copysign(T(0.5), u));
  const T x = 2 * std::numbers::pi_v<T> * (u - T(0.25) * static_cast<T>(quarters)), x2 = x * x;
  T s = fine ? T(-1.0 / 1307674368000) : T(0), c = fine ? T(1.0 / 20922789888000) : T(0);  // 1 / 15!, 1 / 16!
  if constexpr (fine) {
    s = (s * x2 + T(1.0 / 6227020800)) * x2 - T(1.0 / 39916800);           // 13!, 11!
    c = ((c * x2 - T(1.0 / 87178291200)) * x2 + T(1.0 / 479001600)) * x2;  // 14!, 12!
  }
  s = (((s * x2 + T(1.0 / 362880)) * x2 - T(1.0 / 5040)) * x2 + T(1.0 / 120)) * x2 - T(1.0 / 6);
  c = ((((c - T(1.0 / 3628800)) * x2 + T(1.0 / 40320)) * x2 - T(1.0 / 720)) * x2 + T(1.0 / 24)) * x2 - T(0.5);
  s = x + x * x2 * s, c = 1 + x2 * c;
  constexpr std::array<T, 4> along{1, 0, -1, 0}, across{0, 1, 0, -1};
  const auto turned = static_cast<std::size_t>(quarters & 3);
  const T a = along[turned], b = across[turned];
  return {s * a + c * b, c * a - s * b};
}

/// Unit direction about z with density cos(theta) / pi [sr^-1], from u uniform in [0,1)^2; z > 0.
/// Malley's method: a point of the unit disk, lifted. z = sqrt(1 - u.x) needs no cancelling difference.
[[nodiscard]] inline Vec3 cosine_hemisphere(const Vec2& u) {
  const float r = std::sqrt(u.x);
  const auto [sin_phi, cos_phi] = sin_cos_turn(u.y);
  return {r * cos_phi, r * sin_phi, std::sqrt(1 - u.x)};
}

/// What a choice of probability p leaves of its number x, uniform in [0, 1) before and after: to 24 bits.
struct Decision {
  bool first;  // x was below p
  float rest;
};
[[nodiscard]] inline Decision decide(double x, double p) {
  const bool first = x < p;
  const double rest = first ? x / p : (x - p) / (1 - p);
  return {first, std::min(static_cast<float>(rest), 1 - 0x1p-24f)};
}

/// Barycentric coordinates (b1, b2) uniform over a triangle, from u uniform in [0,1)^2.
/// Source: Turk, Generating Random Points in Triangles, Graphics Gems, 1990.
[[nodiscard]] inline std::array<double, 2> uniform_triangle(const Vec2& u) {
  const double root = std::sqrt(static_cast<double>(u.x));
  return {root * (1.0 - u.y), root * u.y};
}

}  // namespace lemma
