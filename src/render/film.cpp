#include "src/render/film.h"

#include <array>
#include <cmath>
#include <limits>

namespace lemma {
namespace {

/// Estimated variance of the mean of independent parts' samples, in one channel: exact on average for parts
/// of equal size, and for others if the variance of their means goes as one over their size.
float variance_of_mean(std::span<const PixelSum> parts, double PixelSum::*channel) {
  double sum = 0, count = 0;
  int filled = 0;
  for (const PixelSum& part : parts) {
    sum += part.*channel;
    count += static_cast<double>(part.count);
    filled += static_cast<int>(part.count > 0);
  }
  if (filled < 2) return 0;
  const double mean = sum / count;
  double squares = 0;
  for (const PixelSum& part : parts) {
    if (part.count == 0) continue;
    const auto size = static_cast<double>(part.count);
    const double difference = part.*channel / size - mean;
    squares += size / count * difference * difference;
  }
  return static_cast<float>(std::min(squares / (filled - 1), double{std::numeric_limits<float>::max()}));
}

Rgb variance_of_mean(std::span<const PixelSum> parts) {
  return {variance_of_mean(parts, &PixelSum::r), variance_of_mean(parts, &PixelSum::g),
          variance_of_mean(parts, &PixelSum::b)};
}

/// The halves: the cell in the middle goes where it makes them more equal.
std::array<PixelSum, 2> halves(std::span<const PixelSum> cells) {
  std::array<PixelSum, 2> halves = {cells[0], cells[2]};
  halves[cells[2].count > cells[0].count ? 0 : 1] += cells[1];
  return halves;
}

}  // namespace

Film::Film(int width, int height, std::uint32_t replicates)
    : width_(width), height_(height), replicates_(replicates) {
  sums_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * cells_a_pixel());
}

void Film::join_halves(int x, int y, std::size_t width) {
  PixelSum* c = cells(x, y);
  for (std::size_t i = 0; i < width; ++i, c += cells_a_pixel()) {
    c[0] += c[1];
    c[1] = c[2];
    c[2] = {};
  }
}

Image Film::image() const {
  Image image{width_, height_, {}};
  image.pixels.reserve(sums_.size() / cells_a_pixel());
  for (std::size_t i = 0; i < sums_.size(); i += cells_a_pixel()) {
    PixelSum all = sums_[i];
    for (std::size_t k = 1; k < cells_a_pixel(); ++k) all += sums_[i + k];
    image.pixels.push_back(all.mean());
  }
  return image;
}

Image Film::variance() const {
  Image variance{width_, height_, {}};
  variance.pixels.reserve(sums_.size() / cells_a_pixel());
  for (std::size_t i = 0; i < sums_.size(); i += cells_a_pixel()) {
    const std::span<const PixelSum> cells(&sums_[i], cells_a_pixel());
    variance.pixels.push_back(
        variance_of_mean(replicates_ > 1 ? cells : std::span<const PixelSum>(halves(cells))));
  }
  return variance;
}

}  // namespace lemma
