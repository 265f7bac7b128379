#include "src/measure/estimated_error.h"

#include <algorithm>
#include <cmath>

#include "src/measure/channels.h"
#include "src/measure/error_figures.h"
#include "src/measure/significance.h"

namespace lemma {
namespace {

constexpr double kTail = 0.025;           // beyond either end of an interval
constexpr double kLargestFreedom = 1e12;  // no image has more pixels

/// Mean of estimates of variances with its confidence interval.
class MeanVariance {
 public:
  void add(double variance) { sum_ += variance, squares_ += variance * variance, ++count_; }

  [[nodiscard]] Interval interval() const {
    if (sum_ <= 0) return {};
    const double mean = sum_ / static_cast<double>(count_);
    const double freedom = std::min(2 * sum_ / (squares_ / sum_), kLargestFreedom);
    const double low = freedom / chi_square_quantile(1 - kTail, freedom);
    const double high = freedom / chi_square_quantile(kTail, freedom);
    return {mean, mean * low, mean * high};
  }

 private:
  double sum_ = 0, squares_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

EstimatedError estimated_error(const Image& image, const Image& variance) {
  MeanVariance mse, relmse;
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
