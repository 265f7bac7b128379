#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/render/film.h"

namespace lemma {

/// An image with what is known of its noise.
struct NoisyImage {
  const Image& mean;
  const Image& variance;  // of each value of `mean`, estimated without bias from independent parts
  int freedom;            // degrees of freedom of each estimate of a variance: the number of parts less 1
};

struct TestSettings {
  double false_alarm = 1e-3;  // chance that two renderings of the same mean are called different
  int block = 16;             // edge of a block [pixels]
};

/// One test: a mean difference in units of its standard error, as a standard normal variable if the means are
/// the same.
struct BlockTest {
  int x = 0, y = 0;  // the block's first pixel
  int channel = 0;
  double z = 0;
};

struct StatisticalResult {
  std::array<double, 3> difference{};      // of the image means, a channel
  std::array<double, 3> standard_error{};  // of the same
  std::array<double, 3> global_z{};
  double global_limit = 0;  // of |z|
  BlockTest worst;          // the largest |z| of a block and channel
  double block_limit = 0;   // of |z|
  std::uint64_t block_tests = 0;
  std::uint64_t block_alarms = 0;  // tests beyond the limit

  /// Whether the images are too different to have the same mean.
  [[nodiscard]] bool different() const;
};

/// Tests whether two renderings could have the same mean: the means of all blocks and channels, and those of
/// the whole image, which see a small bias of everything. Half the chance of a false alarm goes to each, by
/// Sidak's correction within. Variances of a block's pixels add up, and Student's distribution with the
/// degrees of freedom of that sum takes the place of the normal one (Welch, Satterthwaite 1946, with squares
/// of estimated variances corrected for their own noise).
/// @param a, b  of the same size; the noise of different pixels is independent, and of a and of b
[[nodiscard]] StatisticalResult test_equal_means(const NoisyImage& a, const NoisyImage& b,
                                                 const TestSettings& settings);

}  // namespace lemma
