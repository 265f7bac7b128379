#include "src/measure/estimated_error.h"

#include <algorithm>
#include <cmath>

#include "src/measure/channels.h"
#include "src/measure/error_figures.h"

namespace lemma {
namespace {

constexpr double kNormal95 = 1.959964;  // 97.5 % quantile

/// Mean of independent values with its confidence interval.
class Mean {
 public:
  void add(double value) { sum_ += value, squares_ += value * value, ++count_; }

  [[nodiscard]] Interval interval() const {
    const double n = static_cast<double>(count_), mean = sum_ / n;
    if (mean <= 0) return {};
    const double variance = std::max(0.0, squares_ / n - mean * mean) / std::max(1.0, n - 1);
    const double factor = std::exp(kNormal95 * std::sqrt(variance) / mean);
    return {mean, mean / factor, mean * factor};
  }

 private:
  double sum_ = 0, squares_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

EstimatedError estimated_error(const Image& image, const Image& variance) {
  Mean mse, relmse;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto value = channels(image.pixels[i]), v = channels(variance.pixels[i]);
    double relative = 0;
    for (std::size_t c = 0; c < 3; ++c) relative += v[c] / (value[c] * value[c] + kRelativeFloor);
    mse.add((v[0] + v[1] + v[2]) / 3);
    relmse.add(relative / 3);
  }
  const Interval squares = mse.interval();
  return {.rmse = {std::sqrt(squares.value), std::sqrt(squares.low), std::sqrt(squares.high)},
          .relmse = relmse.interval()};
}

}  // namespace lemma
