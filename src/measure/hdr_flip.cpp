#include <algorithm>
#include <cmath>

#include "src/measure/flip.h"
#include "src/render/tone_map.h"

namespace lemma {
namespace {

/// Narkowicz' fit of the ACES curve, (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5), without its exposure of 0.6.
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;
constexpr double kShown = 0.85;  // what the curve makes of the brightest and of the median pixel

/// The radiance of which the curve makes `y`.
double aces_inverse(double y) {
  const double a = k0 - k3 * y, half_b = (k1 - k4 * y) / (2 * a), c = -k5 * y / a;
  return -half_b + std::sqrt(half_b * half_b - c);
}

float aces(float radiance, double scale) {
  const double x = std::max(0.0f, radiance) * scale;
  const double y = (k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5);
  return static_cast<float>(std::isfinite(y) ? std::clamp(y, 0.0, 1.0) : 1.0);
}

/// As the picture of an exposure [stops] shows the image.
Image exposed(const Image& image, double exposure) {
  const double scale = std::exp2(exposure);
  Image shown = image;
  for (Rgb& c : shown.pixels) c = {aces(c.r, scale), aces(c.g, scale), aces(c.b, scale)};
  return apply(ToneMap{}, shown);
}

}  // namespace

FlipExposures flip_exposures(const Image& reference) {
  std::vector<float> lit;
  for (const Rgb& c : reference.pixels) {
    if (luminance(c) > 0) lit.push_back(luminance(c));
  }
  if (lit.empty()) return {};
  std::ranges::sort(lit);
  const std::size_t black = reference.pixels.size() - lit.size(), pixels = reference.pixels.size();
  // The median of all pixels, rank (n - 1) / 2 or the mean of the two in the middle, if it is not black.
  const auto ranked = [&](std::size_t rank) { return rank < black ? 0.0 : double{lit[rank - black]}; };
  double median = (ranked((pixels - 1) / 2) + ranked(pixels / 2)) / 2;
  if (median == 0) median = double{lit[lit.size() / 2]};
  const double shown = aces_inverse(kShown);
  const double first = std::log2(shown / double{lit.back()}), last = std::log2(shown / median);
  const int count = std::max(2, static_cast<int>(std::ceil(last - first)));
  return {first, (last - first) / (count - 1), count};
}

std::vector<float> hdr_flip(const Image& image, const Image& reference) {
  const FlipExposures exposures = flip_exposures(reference);
  std::vector<float> largest(image.pixels.size(), 0.0f);
  for (int i = 0; i < exposures.count; ++i) {
    const double exposure = exposures.exposure(i);
    const std::vector<float> flip = ldr_flip(exposed(image, exposure), exposed(reference, exposure));
    std::ranges::transform(largest, flip, largest.begin(), [](float a, float b) { return std::max(a, b); });
  }
  return largest;
}

}  // namespace lemma
