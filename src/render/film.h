#pragma once

#include <cstdint>
#include <vector>

#include "src/core/rgb.h"

namespace lemma {

/// Linear colours, row 0 at the top.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  // row by row

  [[nodiscard]] const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }
  [[nodiscard]] Rgb& at(int x, int y) { return pixels[index(x, y)]; }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// The sum of a pixel's samples, in double: at 2^24 samples a float sum of ones stops growing.
struct PixelSum {
  double r = 0, g = 0, b = 0;

  void add(const Rgb& sample) { r += sample.r, g += sample.g, b += sample.b; }
  [[nodiscard]] Rgb mean(std::uint64_t samples) const {
    const double scale = samples > 0 ? 1.0 / static_cast<double>(samples) : 0.0;
    return {static_cast<float>(r * scale), static_cast<float>(g * scale), static_cast<float>(b * scale)};
  }
};

/// A sample that was no radiance: NaN, infinite or negative in a channel.
struct InvalidSample {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
  Rgb value;
};

}  // namespace lemma
