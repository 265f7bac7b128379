#include "src/measure/estimated_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "src/core/sampler.h"
#include "src/measure/error_figures.h"
#include "src/render/render.h"

namespace lemma {
namespace {

constexpr int kEdge = 48;
constexpr int kRuns = 400;

double normal(Sampler& random) {
  const Vec2 u = random.next_2d();
  return std::sqrt(-2 * std::log1p(-double{u.x})) * std::cos(2 * std::numbers::pi * double{u.y});
}

/// Variance of the mean of a pixel: of three magnitudes over the image.
double variance_at(std::uint32_t pixel) {
  return 1e-4 * (1 + pixel % 3) * (pixel % 7 == 0 ? 10 : 1);
}

struct Rendered {
  Image image, variance;
};

/// A rendering of a scene of radiance 1: two halves with normal noise, the same in all channels.
Rendered rendered(std::uint64_t seed) {
  Rendered r{{kEdge, kEdge, {}}, {kEdge, kEdge, {}}};
  for (std::uint32_t i = 0; i < kEdge * kEdge; ++i) {
    Sampler random(seed, i, 0);
    const double deviation = std::sqrt(2 * variance_at(i)), a = deviation * normal(random),
                 b = deviation * normal(random);
    const auto mean = static_cast<float>(1 + (a + b) / 2), v = static_cast<float>((a - b) * (a - b) / 4);
    r.image.pixels.push_back({mean, mean, mean});
    r.variance.pixels.push_back({v, v, v});
  }
  return r;
}

double true_mse() {
  double sum = 0;
  for (std::uint32_t i = 0; i < kEdge * kEdge; ++i) sum += variance_at(i);
  return sum / (kEdge * kEdge);
}

/// 95 % intervals hold the truth in 366 of 400 runs or more but with a chance of 0.1 % (binomial), and since
/// they are rather too wide there is no upper limit short of all.
TEST(EstimatedError, IntervalsCoverAtTheirRate) {
  int covered = 0, covered_relative = 0;
  double sum = 0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    const Rendered r = rendered(seed);
    const EstimatedError e = estimated_error(r.image, r.variance);
    const double truth = std::sqrt(true_mse()), relative = true_mse() / 1.01;
    covered += static_cast<int>(e.rmse.low <= truth && truth <= e.rmse.high);
    covered_relative += static_cast<int>(e.relmse.low <= relative && relative <= e.relmse.high);
    sum += e.rmse.value * e.rmse.value;
  }
  EXPECT_GE(covered, 366);
  EXPECT_GE(covered_relative, 366);
  EXPECT_LT(covered, kRuns) << "intervals that always hold the truth are too wide";
  // 2304 estimates of one degree of freedom each: a relative standard error of about 2 sqrt(2 / 2304 / 400).
  EXPECT_NEAR(sum / kRuns / true_mse(), 1, 5 * 2 * std::sqrt(2.0 / (kEdge * kEdge) / kRuns));
}

/// A sample's distribution, of known variance.
struct Distribution {
  const char* name;
  double variance;
  double (*sample)(Sampler&, std::uint32_t pixel);
};

constexpr double kTailIndex = 4.5;  // of Pareto's distribution: the fourth moment is barely finite
constexpr double kEdgeRadiance = 30, kEdgeCover = 0.3;

double uniform(Sampler& random) {
  return 1 - double{random.next()};
}

double pareto(Sampler& random, std::uint32_t /*pixel*/) {
  return std::pow(uniform(random), -1 / kTailIndex);
}

double log_normal(Sampler& random, std::uint32_t /*pixel*/) {
  return std::exp(normal(random));
}

/// A lamp that is seen in three tenths of pixel 0 alone carries 0.9 of the variance of the whole image.
double lamp_edge(Sampler& random, std::uint32_t pixel) {
  if (pixel == 0) return uniform(random) <= kEdgeCover ? kEdgeRadiance : 0;
  return uniform(random);
}

const std::vector<Distribution>& heavy_tails() {
  constexpr double kPixels = kEdge * kEdge;
  const double lamp = kEdgeRadiance * kEdgeRadiance * kEdgeCover * (1 - kEdgeCover);
  static const std::vector<Distribution> all = {
      {"Pareto", kTailIndex / std::pow(kTailIndex - 1, 2) / (kTailIndex - 2), pareto},
      {"log-normal", std::numbers::e * (std::numbers::e - 1), log_normal},
      {"edge of a lamp", (lamp + (kPixels - 1) / 12) / kPixels, lamp_edge},
  };
  return all;
}

/// 95 % intervals hold the truth in 366 of 400 runs or more but with a chance of 0.1 % (binomial); no upper
/// limit, since intervals that hold whatever the tail are too wide where it is light.
TEST(EstimatedError, IntervalsCoverAtTheirRateWithHeavyTails) {
  constexpr std::uint32_t kSamples = 16;
  for (const Distribution& d : heavy_tails()) {
    const double truth = std::sqrt(d.variance / kSamples);
    int covered = 0;
    for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
      Film film(kEdge, kEdge, RenderSettings::kIndependentParts);
      for (std::uint32_t pixel = 0; pixel < kEdge * kEdge; ++pixel) {
        Sampler random(seed, pixel, 0);
        for (std::uint32_t i = 0; i < kSamples; ++i) {
          const auto x = static_cast<float>(d.sample(random, pixel));
          film.run(static_cast<int>(pixel) % kEdge, static_cast<int>(pixel) / kEdge, 1, i).add(0, {x, x, x});
        }
      }
      const Interval rmse = estimated_error(film.image(), film.variance()).rmse;
      covered += static_cast<int>(rmse.low <= truth && truth <= rmse.high);
    }
    std::printf("%-16s RMSE within its interval in %d of %d runs\n", d.name, covered, kRuns);
    EXPECT_GE(covered, 366) << d.name;
  }
}

/// E (I - R)^2 - Var R = Var I: over the runs, the figures of an image against a noisy reference less its
/// noise are those against the true image. Bounds: 5 standard errors, each square being of one degree of
/// freedom.
TEST(EstimatedError, ReferenceNoiseIsSubtractedWithoutBias) {
  const Image truth{kEdge, kEdge, std::vector<Rgb>(kEdge * kEdge, Rgb{1, 1, 1})};
  double corrected = 0, raw = 0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    const Rendered image = rendered(2 * seed), reference = rendered(2 * seed + 1);
    const double error = error_figures(image.image, reference.image).mse;
    raw += error / kRuns;
    corrected += (error - reference_noise(reference.image, reference.variance).mse) / kRuns;
  }
  const double bound = 5 * 4 * std::sqrt(2.0 / (kEdge * kEdge) / kRuns);
  EXPECT_NEAR(corrected / true_mse(), 1, bound);
  EXPECT_NEAR(raw / true_mse(), 2, bound);
}

TEST(EstimatedError, WithoutVarianceIsZero) {
  const Image image{1, 1, {{1, 1, 1}}}, none{1, 1, {{0, 0, 0}}};
  EXPECT_EQ(estimated_error(image, none).rmse.value, 0);
}

}  // namespace
}  // namespace lemma
