#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "src/core/named.h"
#include "src/core/sobol.h"
#include "src/core/vec.h"

namespace lemma {

/// Four 32-bit words, uniform and independent for different (counter, key): Philox4x32-10.
/// Source: Salmon et al., Parallel Random Numbers: As Easy as 1, 2, 3, SC 2011.
[[nodiscard]] inline std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                                             std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53u} * counter[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
               static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key[0] += 0x9E3779B9u;  // the golden ratio
    key[1] += 0xBB67AE85u;  // sqrt(3) - 1
  }
  return counter;
}

/// The bijection of SplitMix64: its values for successive multiples of kGoldenGamma, from any start, are
/// uniform and independent. Source: Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators,
/// OOPSLA 2014, with Stafford's thirteenth set of constants.
[[nodiscard]] constexpr std::uint64_t split_mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}
inline constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15u;  // the golden ratio

/// How the numbers of a pixel's samples relate to each other.
enum class Sequence {
  sobol,       // stratified: Owen-scrambled Sobol, a set of its own for each draw
  independent  // not at all
};

[[nodiscard]] std::span<const Named<Sequence>> sequences();

/// The random numbers of one camera sample. They depend on (seed, pixel, sample index) and on how many were
/// drawn before, on nothing else: not on threads, tiles or other pixels. With Sequence::sobol the n-th draws
/// of a pixel's samples are spread evenly over the line or, drawn as pairs, the square, and a pair with its
/// partner over four dimensions; other draws, pixels and seeds are independent. With `replicates` above 1,
/// the samples i, i + replicates, i + 2 replicates, ... have a scrambling of their own, independent of the
/// others.
///
/// Independent numbers are words of Philox. The keys of scramblings are those of a SplitMix64 for each pixel,
/// which takes a seventh of the work; it starts at an output of the seed's own. They repeat each other by
/// chance alone: 10^6 pixels with 100 keys each share one with a probability of 10^-5.
class Sampler {
 public:
  Sampler() : Sampler(0, 0, 0) {}
  Sampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample,
          Sequence sequence = Sequence::independent, std::uint32_t replicates = 1)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        pixel_(pixel),
        sample_(sample),
        sequence_(sequence) {
    if (sequence == Sequence::sobol) start_sobol(seed, sample / replicates, sample % replicates);
  }

  /// Uniform 32-bit integer: for choices among many, where 24 bits are too few.
  [[nodiscard]] std::uint32_t next_bits() {
    if (sequence_ == Sequence::independent) return next_independent();
    return bits_of(reversed_index_, next_keys());
  }

  /// Uniform in [0, 1): a multiple of 2^-24, never 1.
  [[nodiscard]] float next() { return to_unit(next_bits()); }

  /// A pair of which x is for a choice and what follows it: x to 53 bits, so that there are enough left.
  struct ChoicePair {
    double x;  // in [0, 1), a multiple of 2^-53
    float y;   // as next()
  };

  /// As next_2d. With Sequence::sobol the 32 bits of the sequence are followed by others, the same for all
  /// samples of a set, that move its points within their places.
  [[nodiscard]] ChoicePair next_choice_pair() {
    if (sequence_ == Sequence::independent) {
      const std::uint32_t coarse = next_independent(), fine = next_independent();
      return {to_unit(coarse, fine), next()};
    }
    const std::uint64_t keys = next_keys(), more = next_keys();
    order_ = low(keys);
    return choice_pair_of(reversed_index_, keys, more);
  }

  /// next_choice_pair(), spread evenly in four dimensions together with the pair drawn last, if that has no
  /// partner yet: a choice of a light goes with the direction by which the place that it lights was found.
  [[nodiscard]] ChoicePair next_partner_pair() {
    if (sequence_ == Sequence::independent) return next_choice_pair();
    const std::uint64_t keys = next_keys(), more = next_keys();
    const std::uint32_t order = std::exchange(order_, low(keys));
    return partner_pair_of(reversed_index_, order, keys, more);
  }

  [[nodiscard]] Vec2 next_2d() {
    if (sequence_ == Sequence::independent) {
      const float x = next();
      return {x, next()};
    }
    return pair_of(reversed_index_, next_pair_keys());
  }

  // What is done with Sequence::sobol, in parts, for who draws for many samples. The keys of a draw, one word
  // or two for a pair, are those of all samples of a pixel (and replicate): successive outputs of SplitMix64.

  struct PairKeys {
    std::uint32_t order, x, y;
  };
  [[nodiscard]] static PairKeys pair_keys(std::uint64_t keys, std::uint64_t more) {
    return {low(keys), high(keys), low(more)};
  }

  /// Draws a pair, of which it returns the keys.
  [[nodiscard]] PairKeys next_pair_keys() {
    const std::uint64_t keys = next_keys();
    order_ = low(keys);
    return pair_keys(keys, next_keys());
  }

  /// next() of the sample with this index within its replicate.
  [[nodiscard]] static float unit_of(std::uint32_t reversed_index, std::uint64_t keys) {
    return to_unit(bits_of(reversed_index, keys));
  }
  /// next_2d()
  [[nodiscard]] static Vec2 pair_of(std::uint32_t reversed_index, const PairKeys& keys) {
    const std::uint32_t index = shuffled_index(reversed_index, keys.order);
    const std::uint64_t point = scrambled_sobol(index, keys.x, keys.y);
    return {to_unit(high(point)), to_unit(low(point))};
  }
  /// next_choice_pair()
  [[nodiscard]] static ChoicePair choice_pair_of(std::uint32_t reversed_index, std::uint64_t keys,
                                                 std::uint64_t more) {
    return choice_pair_at(shuffled_index(reversed_index, low(keys)), keys, more);
  }
  /// next_partner_pair(), `order` being the lower half of the keys of the pair drawn last
  [[nodiscard]] static ChoicePair partner_pair_of(std::uint32_t reversed_index, std::uint32_t order,
                                                  std::uint64_t keys, std::uint64_t more) {
    return choice_pair_at(partner_index(shuffled_index(reversed_index, order)), keys, more);
  }

 private:
  friend class SamplerWave;

  // Signed, as SSE and AVX2 convert to floating point.
  static float to_unit(std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;
  }
  static double to_unit(std::uint32_t coarse, std::uint32_t fine) {
    const double upper = static_cast<std::int32_t>(coarse ^ 0x80000000u) + 0x1p31;
    return (upper * 0x1p21 + static_cast<std::int32_t>(fine >> 11)) * 0x1p-53;
  }
  static std::uint32_t low(std::uint64_t keys) { return static_cast<std::uint32_t>(keys); }
  static std::uint32_t high(std::uint64_t keys) { return static_cast<std::uint32_t>(keys >> 32); }
  static ChoicePair choice_pair_at(std::uint32_t index, std::uint64_t keys, std::uint64_t more) {
    const std::uint64_t point = scrambled_sobol(index, high(keys), low(more));
    return {to_unit(high(point), high(more)), to_unit(low(point))};
  }
  static std::uint32_t bits_of(std::uint32_t reversed_index, std::uint64_t keys) {
    return scrambled_sobol_x(shuffled_index(reversed_index, low(keys)), high(keys));
  }

  std::uint32_t next_independent() {
    if (used_ == 4) {
      words_ = philox4x32({pixel_, sample_, block_++, 0}, key_);
      used_ = 0;
    }
    return words_[used_++];
  }

  void start_sobol(std::uint64_t seed, std::uint32_t index, std::uint32_t replicate) {
    const std::uint64_t set = std::uint64_t{pixel_} << 32 | replicate;
    keys_ = split_mix(split_mix(seed) + set * kGoldenGamma);
    reversed_index_ = reverse_bits(index);
  }

  std::uint64_t next_keys() { return split_mix(keys_ += kGoldenGamma); }

  std::array<std::uint32_t, 2> key_;
  std::uint32_t pixel_, sample_, block_ = 0;
  std::array<std::uint32_t, 4> words_{};
  std::uint32_t used_ = 4;
  std::uint32_t reversed_index_ = 0;
  std::uint32_t order_ = 0;  // of the pair drawn last: the lower half of its keys
  std::uint64_t keys_ = 0;
  Sequence sequence_;
};

}  // namespace lemma
