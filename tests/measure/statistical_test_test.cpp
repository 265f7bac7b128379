#include "src/measure/statistical_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "src/core/sampler.h"
#include "src/measure/significance.h"

namespace lemma {
namespace {

/// Noise of mean 0 and variance 1.
using Noise = std::function<double(Sampler&)>;

double normal(Sampler& random) {
  const Vec2 u = random.next_2d();
  return std::sqrt(-2 * std::log1p(-double{u.x})) * std::cos(2 * std::numbers::pi * double{u.y});
}

/// Exponential: as skew as the noise of pixels whose light one path of several finds.
double skew(Sampler& random) {
  return -std::log1p(-double{random.next()}) - 1;
}

struct Rendering {
  Image mean, variance;
};

/// What a renderer makes of a scene whose every pixel has this mean and, for each of its parts, this standard
/// deviation: means and variances of the mean over `parts` independent parts.
Rendering synthetic(const Image& truth, double deviation, int parts, std::uint64_t seed, const Noise& noise) {
  Rendering r{truth, truth};
  for (std::uint32_t i = 0; i < truth.pixels.size(); ++i) {
    Sampler random(seed, i, 0);
    const auto channel = [&](float expected, float& mean, float& variance) {
      double sum = 0, squares = 0;
      for (int k = 0; k < parts; ++k) {
        const double value = double{expected} * (1 + deviation * noise(random));
        sum += value;
        squares += value * value;
      }
      const double average = sum / parts;
      mean = static_cast<float>(average);
      variance = static_cast<float>(std::max(0.0, squares / parts - average * average) / (parts - 1));
    };
    const Rgb& t = truth.pixels[i];
    channel(t.r, r.mean.pixels[i].r, r.variance.pixels[i].r);
    channel(t.g, r.mean.pixels[i].g, r.variance.pixels[i].g);
    channel(t.b, r.mean.pixels[i].b, r.variance.pixels[i].b);
  }
  return r;
}

Image smooth_image(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto u = static_cast<float>(x) / static_cast<float>(width),
                 v = static_cast<float>(y) / static_cast<float>(height);
      image.pixels.push_back({0.5f + u, 0.2f + v, 1 + u * v});
    }
  }
  return image;
}

Image scaled(Image image, float factor) {
  for (Rgb& c : image.pixels) c *= factor;
  return image;
}

StatisticalResult test_of(const Rendering& a, const Rendering& b, int parts, const TestSettings& settings) {
  return test_equal_means({a.mean, a.variance, parts - 1}, {b.mean, b.variance, parts - 1}, settings);
}

/// Of 1000 pairs of equal mean, how many are called different?
int false_alarms(int parts, const Noise& noise, const TestSettings& settings) {
  const Image truth = smooth_image(32, 32);
  int alarms = 0;
  for (std::uint64_t run = 0; run < 1000; ++run) {
    const Rendering a = synthetic(truth, 0.3, parts, 2 * run, noise);
    const Rendering b = synthetic(truth, 0.3, parts, 2 * run + 1, noise);
    alarms += static_cast<int>(test_of(a, b, parts, settings).different());
  }
  return alarms;
}

/// A stated rate of 1 % gives more than 22 alarms in 1000 runs with a chance of 2e-4 (binomial).
TEST(StatisticalTest, CriesWolfNoMoreThanStated) {
  const TestSettings settings{.false_alarm = 0.01, .block = 8};
  for (const int parts : {2, 4, 8}) {
    EXPECT_LE(false_alarms(parts, normal, settings), 22) << parts << " parts, normal noise";
    EXPECT_LE(false_alarms(parts, skew, settings), 22) << parts << " parts, exponential noise";
  }
}

/// 0.1 % of 256 x 256 pixels of 3 % noise each: 5.7 standard errors of the green mean of the difference,
/// 0.03 sqrt(2) sqrt(E m^2) / (E m sqrt(65536)) = 0.00018 of it, against the limit of 3.76. All of 50 runs
/// see it but with a chance of 50 P(z < 3.76 - 5.7) < 0.7 for one of them missed by one channel; three
/// channels with their own noise miss it together with 50 * 0.014^3.
TEST(StatisticalTest, FindsABiasOfOneInAThousand) {
  const Image truth = smooth_image(256, 256);
  for (std::uint64_t run = 0; run < 50; ++run) {
    const Rendering a = synthetic(scaled(truth, 1.001f), 0.06, 4, 2 * run, normal);
    const Rendering b = synthetic(truth, 0.06, 4, 2 * run + 1, normal);
    const StatisticalResult result = test_of(a, b, 4, {});
    EXPECT_TRUE(result.different());
    EXPECT_EQ(result.block_alarms, 0u) << "no block alone can show it";
    EXPECT_NEAR(result.difference[1] / (0.7 * 0.001), 1, 1);
  }
}

TEST(StatisticalTest, FindsOneWrongBlockAndWhere) {
  const Image truth = smooth_image(128, 96);
  Image wrong = truth;
  for (int y = 32; y < 48; ++y) {
    for (int x = 64; x < 80; ++x) wrong.at(x, y).g *= 1.2f;
  }
  const StatisticalResult result =
      test_of(synthetic(wrong, 0.3, 4, 1, normal), synthetic(truth, 0.3, 4, 2, normal), 4, {});
  EXPECT_TRUE(result.different());
  EXPECT_EQ(std::tuple(result.worst.x, result.worst.y, result.worst.channel), std::tuple(64, 32, 1));
  EXPECT_GT(result.worst.z, 0);
}

TEST(StatisticalTest, WithoutNoiseOnlyEqualImagesAreEqual) {
  const Image truth = smooth_image(20, 20), none{20, 20, std::vector<Rgb>(400)};
  EXPECT_FALSE(test_equal_means({truth, none, 3}, {truth, none, 3}, {}).different());
  Image other = truth;
  other.at(19, 19).b += 1e-3f;
  EXPECT_TRUE(test_equal_means({other, none, 3}, {truth, none, 3}, {}).different());
}

TEST(Significance, KnownQuantiles) {
  EXPECT_NEAR(z_limit(sidak(1e-3, 4096)), 5.16, 0.005);
  EXPECT_NEAR(z_limit(sidak(1e-3, 921600)), 6.10, 0.005);
  EXPECT_NEAR(z_of_t(12.706, 1), 1.96, 1e-3);  // 95 % of Student's t with one degree of freedom
  EXPECT_NEAR(z_of_t(-2.2281, 10), -1.96, 1e-3);
  EXPECT_DOUBLE_EQ(z_of_t(3, 1e9), 3);
  EXPECT_EQ(z_of_t(std::numeric_limits<double>::infinity(), 1), 37);
}

}  // namespace
}  // namespace lemma
