#pragma once

#include <array>
#include <cstdint>

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

/// The random numbers of one camera sample. They depend on (seed, pixel, sample index) and on how many were
/// drawn before, on nothing else: not on threads, tiles or other pixels.
class Sampler {
 public:
  Sampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        pixel_(pixel),
        sample_(sample) {}

  /// Uniform 32-bit integer: for choices among many, where 24 bits are too few.
  [[nodiscard]] std::uint32_t next_bits() {
    if (used_ == 4) {
      words_ = philox4x32({pixel_, sample_, block_++, 0}, key_);
      used_ = 0;
    }
    return words_[used_++];
  }

  /// Uniform in [0, 1): a multiple of 2^-24, never 1.
  [[nodiscard]] float next() { return static_cast<float>(next_bits() >> 8) * 0x1p-24f; }

  [[nodiscard]] Vec2 next_2d() {
    const float x = next();
    return {x, next()};
  }

 private:
  std::array<std::uint32_t, 2> key_;
  std::uint32_t pixel_, sample_, block_ = 0;
  std::array<std::uint32_t, 4> words_{};
  std::uint32_t used_ = 4;
};

}  // namespace lemma
