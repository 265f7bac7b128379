#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
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

/// The sum of some of a pixel's samples, in double: at 2^24 samples a float sum of ones stops growing. What
/// an addition rounds off goes into the next one, so that the error does not grow with the number of samples:
/// 2^-52 of the sum of their sizes at most (Neumaier; Ogita, Rump, Oishi, Accurate Sum and Dot Product,
/// 2005). What is rounded off is below 2^-53 of the sum; 24 bits of it are enough for 2^30 samples.
struct PixelSum {
  double r = 0, g = 0, b = 0;
  float lost_r = 0, lost_g = 0, lost_b = 0;
  std::uint32_t count = 0;

  void add(const Rgb& sample) {
    add(r, lost_r, sample.r), add(g, lost_g, sample.g), add(b, lost_b, sample.b), ++count;
  }
  PixelSum& operator+=(const PixelSum& o) {
    add(r, lost_r, o.r, o.lost_r), add(g, lost_g, o.g, o.lost_g), add(b, lost_b, o.b, o.lost_b);
    count += o.count;
    return *this;
  }
  /// Black if there is no sample.
  [[nodiscard]] Rgb mean() const {
    const double scale = count > 0 ? 1.0 / static_cast<double>(count) : 0.0;
    return {static_cast<float>(r * scale), static_cast<float>(g * scale), static_cast<float>(b * scale)};
  }

 private:
  /// Knuth's two-sum: what `sum` becomes and what is lost add up exactly.
  static void add(double& sum, float& lost, double value, float also_lost = 0) {
    const double term = value + (double{lost} + also_lost), total = sum + term, added = total - sum;
    lost = static_cast<float>((sum - (total - added)) + (term - added));
    sum = total;
  }
};

/// The samples of all pixels so far, summed in parts from which the variance of their mean can be told. A
/// sample's part depends on its index alone, and each part is summed in the order of the samples: the film is
/// the same however the samples were cut into ranges.
///
/// With R >= 2 replicates, part k holds the samples k, k + R, k + 2 R, ...: scrambled independently, their
/// means give the variance without bias. With one, the parts are the first half of the samples and the rest,
/// cut at a power of two or three times one. Halves of one scrambled sequence are spread to fill each other's
/// gaps: what one has too much the other tends to lack, so that their difference, and the variance made from
/// it, is too large rather than too small. By how much follows from the rate: if the variance of a mean falls
/// as n^-a, 2^a - 1 times, that is once for independent samples.
class Film {
 public:
  Film(int width, int height, std::uint32_t replicates);

  static constexpr std::size_t bytes_a_pixel(std::uint32_t replicates) {
    return cells_of(replicates) * sizeof(PixelSum);
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// Where the samples of one index go, of neighbouring pixels of a row.
  class Run {
   public:
    Run(PixelSum* first, std::size_t stride) : first_(first), stride_(stride) {}
    void add(std::size_t i, const Rgb& value) { first_[i * stride_].add(value); }

   private:
    PixelSum* first_;
    std::size_t stride_;
  };

  /// Of the pixels from (x, y) to the right. Must be called for a pixel's samples in order, once for each
  /// index.
  [[nodiscard]] Run run(int x, int y, std::size_t width, std::uint32_t sample) {
    const bool is_power_of_two = (sample & (sample - 1)) == 0;  // std::has_single_bit is a call
    if (replicates_ == 1 && sample >= 4 && is_power_of_two) join_halves(x, y, width);
    return {cells(x, y) + cell_of(sample), cells_a_pixel()};
  }

  [[nodiscard]] Image image() const;

  /// Estimated variance of the mean of each value [radiance^2], 0 where less than two parts hold samples.
  /// Beyond the range of float it is the largest float.
  [[nodiscard]] Image variance() const;

  /// Independent or nearly independent parts that variance() is made from: it has one degree of freedom less.
  [[nodiscard]] std::uint32_t parts() const { return replicates_ > 1 ? replicates_ : 2; }

 private:
  /// Both halves become the first one, in the pixels of a run.
  void join_halves(int x, int y, std::size_t width);

  /// With one replicate: S samples, S samples and the next up to 2 S, for a power of two S.
  static constexpr std::uint32_t kHalvingCells = 3;

  [[nodiscard]] std::uint32_t cells_a_pixel() const { return cells_of(replicates_); }
  static constexpr std::uint32_t cells_of(std::uint32_t replicates) {
    return replicates > 1 ? replicates : kHalvingCells;
  }
  [[nodiscard]] std::uint32_t cell_of(std::uint32_t sample) const {
    return replicates_ > 1 ? sample % replicates_ : std::min(sample, kHalvingCells - 1);
  }
  [[nodiscard]] std::size_t first_cell(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
           cells_a_pixel();
  }
  [[nodiscard]] PixelSum* cells(int x, int y) { return &sums_[first_cell(x, y)]; }
  [[nodiscard]] std::span<const PixelSum> cells(int x, int y) const {
    return {&sums_[first_cell(x, y)], cells_a_pixel()};
  }

  int width_, height_;
  std::uint32_t replicates_;
  std::vector<PixelSum> sums_;
};

/// A sample that was no radiance: NaN, infinite or negative in a channel.
struct InvalidSample {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
  Rgb value;
};

}  // namespace lemma
