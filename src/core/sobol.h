#pragma once

#include <cstdint>

namespace lemma {

[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00FF00FFu) << 8) | ((x & 0xFF00FF00u) >> 8);
  x = ((x & 0x0F0F0F0Fu) << 4) | ((x & 0xF0F0F0F0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xCCCCCCCCu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xAAAAAAAAu) >> 1);
}

[[nodiscard]] constexpr std::uint64_t reverse_bits(std::uint64_t x) {
  x = __builtin_bswap64(x);
  x = ((x & 0x0F0F0F0F0F0F0F0Fu) << 4) | ((x >> 4) & 0x0F0F0F0F0F0F0F0Fu);
  x = ((x & 0x3333333333333333u) << 2) | ((x >> 2) & 0x3333333333333333u);
  return ((x & 0x5555555555555555u) << 1) | ((x >> 1) & 0x5555555555555555u);
}

/// A bijection in which each bit depends on itself and the lower ones alone: of the reversed bits of a number
/// it is Owen's nested random permutation of base 2, drawn by `key`.
/// Source: Laine, Karras, Stratified Sampling for Stochastic Transparency, EGSR 2011, with the constants of
/// Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 8.6 (FastOwenScrambler).
[[nodiscard]] constexpr std::uint32_t permute_upwards(std::uint32_t x, std::uint32_t key) {
  x ^= x * 0x3D20ADEAu;
  x += key;
  x *= (key >> 16) | 1;
  x ^= x * 0x05526C56u;
  x ^= x * 0x53A22864u;
  return x;
}

/// The second generator matrix of Sobol's sequence, before the digits are reversed: the Pascal triangle
/// modulo 2. C(j, i) is odd exactly if the bits of i are among those of j (Lucas), so digit i is the
/// exclusive or over the supersets of i.
[[nodiscard]] constexpr std::uint32_t pascal_digits(std::uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0F0F0F0Fu;
  index ^= (index >> 8) & 0x00FF00FFu;
  return index ^ (index >> 16);
}

/// The index, within the (0, 2)-sequence, of the pair that together with the pair of `index` is a point of a
/// (0, 4)-sequence of base 4: of the 4^m points from a multiple of 4^m on, each elementary box of base 4 and
/// volume 4^-m holds one. Its matrices are Faure's, C(j, i) b^(j-i) with b = 0, 1, w, w + 1, the numbers of
/// GF(4): 0 for x of `index`, w, which is this function, for x of its partner, and one more for the y of
/// each by pascal_digits(), whose steps within digits of base 4 leave boxes as they are and make each pair
/// a (0, 2)-sequence. A digit is a + b w, two bits, with w^2 = w + 1. Digit i is the sum of w^(j-i) times
/// digit j over the j whose bits are a superset of those of i (Lucas): a step for each bit, by w, w^2,
/// w^4 = w and w^8 = w^2.
/// Sources: Faure, Acta Arithmetica 41, 1982; Niederreiter, Monatshefte fuer Mathematik 104, 1987, for powers
/// of primes.
[[nodiscard]] constexpr std::uint32_t partner_index(std::uint32_t index) {
  constexpr auto times_w = [](std::uint32_t x) {
    return ((x >> 1) & 0x55555555u) | (((x << 1) ^ x) & 0xAAAAAAAAu);
  };
  constexpr auto times_w2 = [](std::uint32_t x) {
    return ((x ^ (x >> 1)) & 0x55555555u) | ((x << 1) & 0xAAAAAAAAu);
  };
  index ^= times_w(index >> 2) & 0x33333333u;
  index ^= times_w2(index >> 4) & 0x0F0F0F0Fu;
  index ^= times_w(index >> 8) & 0x00FF00FFu;
  return index ^ times_w2(index >> 16);
}

// Point `index` of Sobol's (0, 2)-sequence in an order and with a scrambling of its own for each set of keys,
// as two fractions of 2^32: scrambled_sobol() of shuffled_index(). The first N points are stratified for
// every N; points of different keys are independent, so that pairs of dimensions may be padded. Source:
// Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020.

/// The place that the point with this index takes in the order of `key`.
[[nodiscard]] constexpr std::uint32_t shuffled_index(std::uint32_t reversed_index, std::uint32_t key) {
  return reverse_bits(permute_upwards(reversed_index, key));
}

[[nodiscard]] constexpr std::uint32_t scrambled_sobol_x(std::uint32_t shuffled, std::uint32_t key) {
  return reverse_bits(permute_upwards(shuffled, key));
}

/// Both, x in the upper half: their digits are reversed together.
[[nodiscard]] constexpr std::uint64_t scrambled_sobol(std::uint32_t shuffled, std::uint32_t key_x,
                                                      std::uint32_t key_y) {
  const std::uint32_t x = permute_upwards(shuffled, key_x);
  const std::uint32_t y = permute_upwards(pascal_digits(shuffled), key_y);
  return reverse_bits(std::uint64_t{y} << 32 | x);
}

}  // namespace lemma
