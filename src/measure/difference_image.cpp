#include "src/measure/difference_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lemma {
namespace {

constexpr double kShownPart = 0.99;

Rgb color_of(double difference) {
  const double place = (std::clamp(difference, -1.0, 1.0) + 1) / 2 * (kDifferenceColors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kDifferenceColors.size() - 2);
  const auto part = static_cast<float>(place - static_cast<double>(below));
  return kDifferenceColors[below] * (1 - part) + kDifferenceColors[below + 1] * part;
}

double luminance_difference(const Rgb& a, const Rgb& b) {
  return double{luminance(a)} - double{luminance(b)};
}

}  // namespace

Image signed_difference(const Image& image, const Image& reference) {
  Image difference = image;
  std::ranges::transform(image.pixels, reference.pixels, difference.pixels.begin(),
                         [](const Rgb& a, const Rgb& b) { return a + b * -1.0f; });
  return difference;
}

double difference_scale(const Image& image, const Image& reference) {
  std::vector<double> sizes(image.pixels.size());
  std::ranges::transform(image.pixels, reference.pixels, sizes.begin(),
                         [](const Rgb& a, const Rgb& b) { return std::abs(luminance_difference(a, b)); });
  const auto rank = static_cast<std::ptrdiff_t>(kShownPart * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  const double shown = sizes[static_cast<std::size_t>(rank)];
  const double largest = shown > 0 ? shown : *std::ranges::max_element(sizes);
  return largest > 0 ? largest : 1;
}

Image false_color(const Image& image, const Image& reference, double scale) {
  Image colors = image;
  std::ranges::transform(
      image.pixels, reference.pixels, colors.pixels.begin(),
      [&](const Rgb& a, const Rgb& b) { return color_of(luminance_difference(a, b) / scale); });
  return colors;
}

}  // namespace lemma
