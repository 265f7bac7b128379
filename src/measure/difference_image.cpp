#include "src/measure/difference_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lemma {
namespace {

constexpr double kShownPart = 0.99;

/// Colours of differences from -1 to 1, evenly spaced: a diverging map of nearly even steps to the eye, white
/// in the middle. Values in between are mixed.
constexpr std::array<Rgb, 7> kColors = {{{0.02f, 0.19f, 0.38f},
                                         {0.26f, 0.58f, 0.76f},
                                         {0.82f, 0.90f, 0.94f},
                                         {1, 1, 1},
                                         {0.99f, 0.86f, 0.78f},
                                         {0.84f, 0.38f, 0.30f},
                                         {0.40f, 0, 0.12f}}};

Rgb color_of(double difference) {
  const double place = (std::clamp(difference, -1.0, 1.0) + 1) / 2 * (kColors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kColors.size() - 2);
  const auto part = static_cast<float>(place - static_cast<double>(below));
  return kColors[below] * (1 - part) + kColors[below + 1] * part;
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
