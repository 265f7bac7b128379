#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "src/render/film.h"

namespace lemma {

/// What an image file holds.
struct ReadImage {
  Image image;
  std::optional<Image> variance;  // of the mean of each value, from the layer "variance"
  bool linear = false;            // radiance; else values for the screen in [0, 1]
  int parts = 0;                  // independent parts that the variance was estimated from; 0 if not told
  std::string seed;               // of the random numbers it was rendered with; empty if not told
};

/// Reads an image in any format that OpenImageIO knows. Its channels R, G, B must be there; if one of
/// variance.R, variance.G, variance.B is, all are.
/// @throw std::runtime_error whose what() is the message for the user: no such file, no image, other
/// channels, or
///        values that are not finite
[[nodiscard]] ReadImage read_image(const std::filesystem::path& path);

}  // namespace lemma
