#pragma once

#include <array>

namespace lemma {

/// Names in an EXR file: the image, the variance of the mean of each value of it, and the number of
/// independent parts that the variance was estimated from.
inline constexpr std::array<const char*, 3> kColorChannels = {"R", "G", "B"};
inline constexpr std::array<const char*, 3> kVarianceChannels = {"variance.R", "variance.G", "variance.B"};
inline constexpr const char* kPartsAttribute = "lemma:variance-parts";

/// The attribute that tells the seed of the image's random numbers.
inline constexpr const char* kSeedAttribute = "lemma:seed";

}  // namespace lemma
