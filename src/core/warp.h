#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
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
[[gnu::always_inline, nodiscard]] inline SinCos<T> sin_cos_turn(T u) {
  constexpr bool fine = std::is_same_v<T, double>;
  // Adding 1.5 2^23 rounds floats to an integer, which is then found in the lowest bits; 1.5 2^52 doubles.
  constexpr T rounds = fine ? T(0x1.8p52) : T(0x1.8p23);
  const T shifted = 4 * u + rounds;
  const T x = 2 * std::numbers::pi_v<T> * (u - T(0.25) * (shifted - rounds)), x2 = x * x;
  T s = fine ? T(-1.0 / 1307674368000) : T(0), c = fine ? T(1.0 / 20922789888000) : T(0);  // 1 / 15!, 1 / 16!
  if constexpr (fine) {
    s = (s * x2 + T(1.0 / 6227020800)) * x2 - T(1.0 / 39916800);           // 13!, 11!
    c = ((c * x2 - T(1.0 / 87178291200)) * x2 + T(1.0 / 479001600)) * x2;  // 14!, 12!
  }
  s = (((s * x2 + T(1.0 / 362880)) * x2 - T(1.0 / 5040)) * x2 + T(1.0 / 120)) * x2 - T(1.0 / 6);
  c = ((((c - T(1.0 / 3628800)) * x2 + T(1.0 / 40320)) * x2 - T(1.0 / 720)) * x2 + T(1.0 / 24)) * x2 - T(0.5);
  s = x + x * x2 * s, c = 1 + x2 * c;
  // An odd number of quarters exchanges the two, and two of them change both signs: by the bits, since
  // neither a table nor a branch serves loops over lanes, nor a branch numbers at random.
  using Bits = std::conditional_t<fine, std::uint64_t, std::uint32_t>;
  constexpr int sign = 8 * sizeof(Bits) - 2;  // bit 1 becomes the sign's
  const auto s_bits = std::bit_cast<Bits>(s), c_bits = std::bit_cast<Bits>(c);
  const auto quarters = std::bit_cast<Bits>(shifted);
  const Bits exchanged = (s_bits ^ c_bits) & (0 - (quarters & 1));
  return {std::bit_cast<T>((s_bits ^ exchanged) ^ (quarters & 2) << sign),
          std::bit_cast<T>((c_bits ^ exchanged) ^ ((quarters + 1) & 2) << sign)};
}

/// Unit direction about z with density cos(theta) / pi [sr^-1], from u uniform in [0,1)^2; z > 0.
/// Malley's method: a point of the unit disk, lifted. z = sqrt(1 - u.x) needs no cancelling difference.
[[gnu::always_inline, nodiscard]] inline Vec3 cosine_hemisphere(const Vec2& u) {
  const float r = std::sqrt(u.x);
  const auto [sin_phi, cos_phi] = sin_cos_turn(u.y);
  return {r * cos_phi, r * sin_phi, std::sqrt(1 - u.x)};
}

/// What a choice of probability p leaves of its number x, uniform in [0, 1) before and after: to 24 bits.
/// @param first  x < p
[[nodiscard]] inline float rest_of_choice(double x, double p, bool first) {
  constexpr float last = 1 - 0x1p-24f;
  const auto rest = static_cast<float>((first ? x : x - p) / (first ? p : 1 - p));
  return last < rest ? last : rest;
}
struct Decision {
  bool first;  // x was below p
  float rest;
};
[[nodiscard]] inline Decision decide(double x, double p) {
  const bool first = x < p;
  return {first, rest_of_choice(x, p, first)};
}

/// Barycentric coordinates (b1, b2) uniform over a triangle, from u uniform in [0,1)^2.
/// Source: Turk, Generating Random Points in Triangles, Graphics Gems, 1990.
[[nodiscard]] inline std::array<double, 2> uniform_triangle(const Vec2& u) {
  const double root = std::sqrt(static_cast<double>(u.x));
  return {root * (1.0 - u.y), root * u.y};
}

}  // namespace lemma
