#include "src/measure/error_figures.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "src/measure/channels.h"

namespace lemma {
namespace {

double relative_square(double difference, double reference) {
  return difference * difference / (reference * reference + kRelativeFloor);
}

double symmetric_part(double a, double b) {
  const double sum = std::abs(a) + std::abs(b);
  return sum > 0 ? 2 * std::abs(a - b) / sum : 0;
}

/// Mean of the values but for the largest part of them.
double trimmed_mean(std::vector<double> values, double part) {
  const auto kept = values.size() - static_cast<std::size_t>(static_cast<double>(values.size()) * part);
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(kept - 1));
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += values[i];
  return sum / static_cast<double>(kept);
}

}  // namespace

ErrorFigures error_figures(const Image& image, const Image& reference) {
  ErrorFigures sums;
  std::vector<double> relative(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto a = channels(image.pixels[i]), r = channels(reference.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double difference = a[c] - r[c];
      sums.mse += difference * difference;
      relative[i] += relative_square(difference, r[c]);
      sums.smape += symmetric_part(a[c], r[c]);
      sums.mean_difference[c] += difference;
    }
    sums.relmse += relative[i];
  }
  const auto pixels = static_cast<double>(image.pixels.size());
  ErrorFigures means = {.mse = sums.mse / (3 * pixels),
                        .relmse = sums.relmse / (3 * pixels),
                        .trimmed_relmse = trimmed_mean(std::move(relative), kTrimmedPart) / 3,
                        .smape = sums.smape / (3 * pixels)};
  for (std::size_t c = 0; c < 3; ++c) means.mean_difference[c] = sums.mean_difference[c] / pixels;
  return means;
}

ReferenceNoise reference_noise(const Image& reference, const Image& variance) {
  ReferenceNoise sums;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    const auto r = channels(reference.pixels[i]), v = channels(variance.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      sums.mse += v[c];
      sums.relmse += v[c] / (r[c] * r[c] + kRelativeFloor);
    }
  }
  const auto values = 3 * static_cast<double>(reference.pixels.size());
  return {sums.mse / values, sums.relmse / values};
}

std::vector<PixelDifference> largest_differences(const Image& image, const Image& reference,
                                                 std::size_t count) {
  std::vector<PixelDifference> all;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto a = channels(image.at(x, y)), r = channels(reference.at(x, y));
      const double distance = std::hypot(a[0] - r[0], a[1] - r[1], a[2] - r[2]);
      if (distance > 0) all.push_back({x, y, distance});
    }
  }
  const auto kept = static_cast<std::ptrdiff_t>(std::min(count, all.size()));
  std::ranges::partial_sort(all, all.begin() + kept, [](const PixelDifference& a, const PixelDifference& b) {
    return std::tuple(-a.distance, a.y, a.x) < std::tuple(-b.distance, b.y, b.x);
  });
  all.resize(static_cast<std::size_t>(kept));
  return all;
}

}  // namespace lemma
