#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

// Elementary functions without branches, tables or calls, for loops over lanes that compilers turn into
// vector code. They take additions, products, a quotient or a root, selects, and shifts of bits, so that
// single values and lanes of every instruction set get the same bits. Values are found in double: of those
// given as float the result lies within 0.5001 units in the last place, of those given as double within the
// relative error that each states. NaN gives NaN.
namespace lemma::elementary {

namespace detail {

/// The sum of c_k x^k, even and odd powers apart: two chains of half the length.
template <std::size_t Count>
[[gnu::always_inline, nodiscard]] inline double polynomial(double x, const double (&c)[Count]) {
  static_assert(Count >= 2);
  constexpr std::size_t last_even = (Count - 1) / 2 * 2, last_odd = (Count - 2) / 2 * 2 + 1;
  const double x2 = x * x;
  double even = c[last_even], odd = c[last_odd];
#pragma GCC unroll 16
  for (std::size_t k = last_even; k >= 2; k -= 2) even = even * x2 + c[k - 2];
#pragma GCC unroll 16
  for (std::size_t k = last_odd; k >= 2; k -= 2) odd = odd * x2 + c[k - 2];
  return even + odd * x;
}

/// exp(x) = power (1 + rest): power a power of two, |rest| < 0.42, for -708 <= x <= 709; any numbers beyond.
struct Exponential {
  double power, rest;
};
[[gnu::always_inline, nodiscard]] inline Exponential exponential(double x) {
  // Adding 1.5 2^52 rounds to an integer, which is then found in the lowest bits.
  constexpr double rounds = 0x1.8p52, upper_ln2 = 0x1.62e42feep-1, lower_ln2 = 0x1.a39ef35793c76p-33;
  const double shifted = x * std::numbers::log2e + rounds, k = shifted - rounds;
  const double r = (x - k * upper_ln2) - k * lower_ln2;  // |r| <= ln(2) / 2; the first product is exact
  // (exp(r) - 1 - r) / r^2 by Taylor's series: what it leaves out of exp(r) - 1 is below r^11 / 12! of that,
  // 3e-14 with the division by (exp(r) - 1) / r.
  constexpr double c[] = {1.0 / 2,    1.0 / 6,     1.0 / 24,     1.0 / 120,     1.0 / 720,
                          1.0 / 5040, 1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800};
  const double rest = r + r * r * polynomial(r, c);
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(shifted) + 1023;
  return {std::bit_cast<double>(exponent << 52), rest};
}

/// (asin(x) - x) / x for x^2 = x2 <= 1/4.
[[gnu::always_inline, nodiscard]] inline double asin_rest(double x2) {
  // Our own: the polynomial of degree 9 that is (asin(x) / x - 1) / x^2 at the ten Chebyshev nodes of x^2 in
  // [0, 1/4], found with 60 digits; the greatest relative error of asin(x) is then 1.4e-14.
  constexpr double c[] = {0x1.5555555554f05p-3, 0x1.33333335a9cd6p-4, 0x1.6db6d8e71341bp-5,
                          0x1.f1c81c59ea536p-6, 0x1.6e72146fda29ep-6, 0x1.1dc2ef640046fp-6,
                          0x1.b02442413f6b9p-7, 0x1.00d47e7966d94p-6, -0x1.815314c864b10p-9,
                          0x1.c93a92d53b4f2p-6};
  return x2 * polynomial(x2, c);
}

}  // namespace detail

/// exp(-x) for x >= 0, but not below exp(-80), within 2e-14. For what is added to larger numbers: neither
/// subnormal numbers, which cost processors a hundred times as much as others, nor a choice come in its way.
template <class T>
[[gnu::always_inline, nodiscard]] inline T decay(T x) {
  const auto [power, rest] = detail::exponential(-static_cast<double>(std::min(x, T(80))));
  return static_cast<T>(power + power * rest);
}

/// exp(x) for x <= 709, within 2e-14; 0 below -708, where the result nears the least normal number.
[[gnu::always_inline, nodiscard]] inline double exp(double x) {
  const auto [power, rest] = detail::exponential(x);
  return x < -708 ? 0 : power + power * rest;
}

/// exp(x) - 1 for x in [-708, 0], within 4e-14 however small x is.
[[gnu::always_inline, nodiscard]] inline double expm1(double x) {
  const auto [power, rest] = detail::exponential(x);
  return power * rest + (power - 1);
}

/// log(1 + x) for x in (-1, 0], within 4e-14 however small x is. For x <= -1 some finite number.
[[gnu::always_inline, nodiscard]] inline double log1p(double x) {
  // 1 + x = 2^k (1 + f), f in [sqrt(1/2) - 1, sqrt(2) - 1). The exponent e = k + 1023 is an integer in the
  // lowest bits of a number that lies between 2^52 and 2^53.
  constexpr std::uint64_t one = std::bit_cast<std::uint64_t>(1.0),
                          root = std::bit_cast<std::uint64_t>(std::numbers::sqrt2 / 2),
                          integer = std::bit_cast<std::uint64_t>(0x1p52);
  const auto bits = std::bit_cast<std::uint64_t>(1 + x);
  const std::uint64_t e = (bits + (one - root)) >> 52;
  const double k = std::bit_cast<double>(e | integer) - (0x1p52 + 1023);
  const double scaled = std::bit_cast<double>(bits - (e << 52) + one);
  const double f = x < std::numbers::sqrt2 / 2 - 1 ? scaled - 1 : x;  // where k is 0, x has more digits
  // log(1 + f) = 2 artanh(s) with s = f / (2 + f), |s| <= 0.1716: by Taylor's series, whose rest is below
  // s^16 / 17 / (1 - s^2) = 4e-14 of it, and with k != 0 less of the sum.
  const double s = f / (2 + f), s2 = s * s;
  constexpr double c[] = {2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9, 2.0 / 11, 2.0 / 13, 2.0 / 15};
  return k * std::numbers::ln2 + (2 * s + s * (s2 * detail::polynomial(s2, c)));
}

/// asin(x) for |x| <= 1, within 3e-14; NaN beyond.
[[gnu::always_inline, nodiscard]] inline double asin(double x) {
  // Above 1/2 it is pi / 2 - 2 asin(sqrt((1 - |x|) / 2)).
  const double size = std::abs(x), half = 0.5 * (1 - size);
  const bool steep = size > 0.5;
  const double y2 = steep ? half : x * x, y = steep ? std::sqrt(half) : size;
  const double angle = y + y * detail::asin_rest(y2);
  return std::copysign(steep ? std::numbers::pi / 2 - 2 * angle : angle, x);
}

[[gnu::always_inline, nodiscard]] inline float asin(float x) {
  return static_cast<float>(asin(static_cast<double>(x)));
}

/// asin(x) for x in [0, 1] as far as single precision goes, within 4e-7, in a third of the work.
[[gnu::always_inline, nodiscard]] inline float asin_in_single(float x) {
  const float half = 0.5f * (1 - x);
  const bool steep = x > 0.5f;
  const float y2 = steep ? half : x * x, y = steep ? std::sqrt(half) : x;
  // As that of asin_rest, of degree 4: within 1.7e-8 of asin(x).
  const float rest =
      (((0x1.37fe16p-5f * y2 + 0x1.b311d2p-6f) * y2 + 0x1.70a6bcp-5f) * y2 + 0x1.332732p-4f) * y2 +
      0x1.55555ep-3f;
  const float angle = y + y * (y2 * rest);
  return steep ? std::numbers::pi_v<float> / 2 - 2 * angle : angle;
}

}  // namespace lemma::elementary
