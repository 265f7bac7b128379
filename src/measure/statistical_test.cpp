#include "src/measure/statistical_test.h"

#include <algorithm>
#include <cmath>

#include "src/measure/channels.h"
#include "src/measure/significance.h"

namespace lemma {
namespace {

/// Sum of differences, of their variances, and of what the variance of that sum is estimated from.
struct DifferenceSum {
  double difference = 0, variance = 0, uncertainty = 0;

  /// An estimate v of a variance with n degrees of freedom has the variance 2 v^2 / n of the true v, whose
  /// square is estimated by v^2 n / (n + 2).
  void add_variance(double v, int freedom) {
    variance += v;
    uncertainty += 2 * v * v / (freedom + 2);
  }
  DifferenceSum& operator+=(const DifferenceSum& o) {
    difference += o.difference, variance += o.variance, uncertainty += o.uncertainty;
    return *this;
  }
  /// Standard normal if the expected difference is 0. Without any noise every difference is one.
  [[nodiscard]] double z() const {
    if (difference == 0) return 0;
    const double freedom = uncertainty > 0 ? 2 * variance * variance / uncertainty : 1;
    return z_of_t(difference / std::sqrt(variance), freedom);
  }
};

using ChannelSums = std::array<DifferenceSum, 3>;

ChannelSums sum_block(const NoisyImage& a, const NoisyImage& b, int x0, int y0, int edge) {
  ChannelSums sums;
  for (int y = y0; y < std::min(y0 + edge, a.mean.height); ++y) {
    for (int x = x0; x < std::min(x0 + edge, a.mean.width); ++x) {
      const auto mean_a = channels(a.mean.at(x, y)), mean_b = channels(b.mean.at(x, y));
      const auto variance_a = channels(a.variance.at(x, y)), variance_b = channels(b.variance.at(x, y));
      for (std::size_t c = 0; c < 3; ++c) {
        sums[c].difference += mean_a[c] - mean_b[c];
        sums[c].add_variance(variance_a[c], a.freedom);
        sums[c].add_variance(variance_b[c], b.freedom);
      }
    }
  }
  return sums;
}

}  // namespace

bool StatisticalResult::different() const {
  return block_alarms > 0 ||
         std::ranges::any_of(global_z, [this](double z) { return std::abs(z) > global_limit; });
}

StatisticalResult test_equal_means(const NoisyImage& a, const NoisyImage& b, const TestSettings& settings) {
  const int edge = settings.block;
  const auto blocks = [edge](int pixels) { return static_cast<std::uint64_t>((pixels + edge - 1) / edge); };
  StatisticalResult result;
  result.block_tests = 3 * blocks(a.mean.width) * blocks(a.mean.height);
  const double half = sidak(settings.false_alarm, 2);
  result.block_limit = z_limit(sidak(half, static_cast<double>(result.block_tests)));
  result.global_limit = z_limit(sidak(half, 3));

  ChannelSums whole;
  for (int y = 0; y < a.mean.height; y += edge) {
    for (int x = 0; x < a.mean.width; x += edge) {
      const ChannelSums block = sum_block(a, b, x, y, edge);
      for (std::size_t c = 0; c < 3; ++c) {
        const double z = block[c].z();
        if (std::abs(z) > result.block_limit) ++result.block_alarms;
        if (std::abs(z) > std::abs(result.worst.z)) result.worst = {x, y, static_cast<int>(c), z};
        whole[c] += block[c];
      }
    }
  }
  const auto pixels = static_cast<double>(a.mean.pixels.size());
  for (std::size_t c = 0; c < 3; ++c) {
    result.difference[c] = whole[c].difference / pixels;
    result.standard_error[c] = std::sqrt(whole[c].variance) / pixels;
    result.global_z[c] = whole[c].z();
  }
  return result;
}

}  // namespace lemma
