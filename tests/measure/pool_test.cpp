// The statistics of the agreement tests, on noise of known size: do they cry wolf as often as they say, and
// find what they say?

#include "tests/support/pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include "src/core/parallel.h"
#include "src/core/sampler.h"

namespace lemma {
namespace {

using test::Arm;
using test::Draw;
using test::Goal;
using test::Pool;
using test::Pooled;

constexpr std::size_t kPixels = 16;

/// SplitMix64 as the standard library takes it: seeded in no time.
class Random {
 public:
  using result_type = std::uint64_t;
  explicit Random(std::uint64_t seed) : state_(split_mix(seed)) {}
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()() { return split_mix(state_ += kGoldenGamma); }

 private:
  std::uint64_t state_;
};

/// The mean of so many samples of mean 1 and variance 1.
using Noise = std::function<double(Random& random, std::uint32_t spp)>;

double normal(Random& random, std::uint32_t spp) {
  return std::normal_distribution<double>(1, 1 / std::sqrt(spp))(random);
}

/// Exponential samples: as skew as those of pixels whose light one path of several finds. More than 64 are
/// made from 64, and so more skew than they would be.
double skew(Random& random, std::uint32_t spp) {
  const std::uint32_t drawn = std::min(spp, 64u);
  double sum = 0;
  for (std::uint32_t i = 0; i < drawn; ++i) {
    sum -= std::log1p(-std::generate_canonical<double, 53>(random));
  }
  return 1 + (sum / drawn - 1) * std::sqrt(1.0 * drawn / spp);
}

/// Samples are 0 but for one of 400, and are scaled to a variance of 1: that of samples of light areas that a
/// lobe seldom reflects.
double rare(Random& random, std::uint32_t spp) {
  constexpr double kOneOf = 400;
  std::geometric_distribution<std::uint32_t> misses(1 / kOneOf);
  double count = 0;
  for (std::uint32_t i = misses(random); i < spp; i += 1 + misses(random)) ++count;
  return 1 + (count / spp * kOneOf - 1) / std::sqrt(kOneOf - 1);
}

struct Synthetic {
  double mean = 1;              // of a pixel, on average over the pixels
  double deviation = 1;         // of a sample
  double common_deviation = 0;  // of its part that is the same in all estimators with this seed
};

/// Pixels whose means and noise differ by a factor of 2.
Draw draw_of(const std::vector<Synthetic>& estimators, const Noise& noise) {
  return [estimators, noise](std::size_t e, std::uint32_t spp, std::uint64_t seed) {
    const Synthetic& s = estimators[e];
    Random common(seed * 100), own(seed * 100 + e + 1);
    std::vector<double> pixels;
    for (std::size_t p = 0; p < kPixels; ++p) {
      const double scale = (2 + 2 * static_cast<double>(p) / (kPixels - 1)) / 3;
      pixels.push_back(scale * (s.mean + s.deviation * (noise(own, spp) - 1) +
                                s.common_deviation * (noise(common, spp) - 1)));
    }
    return pixels;
  };
}

/// Estimator 0 is the reference, 1 to 4 are tested; 5 to 8 are their partners.
std::vector<Arm> four_arms() {
  std::vector<Arm> arms;
  for (std::size_t i = 1; i <= 4; ++i) {
    arms.push_back({.estimator = i, .partner = i + 4, .cost = i == 3 ? 4.0 : 1.0, .kind = i});
  }
  return arms;
}

/// The tested ones are biased; nothing cancels, or nearly all.
std::vector<Synthetic> estimators(double bias, bool cancels) {
  std::vector<Synthetic> all{{1, 0.3, 0}};
  for (const double mean : {1 + bias, 1.0}) {
    for (const double deviation : {0.5, 2.0, 0.4, 8.0}) {
      all.push_back({mean, cancels ? 0.2 * deviation : deviation, cancels ? deviation : 0});
    }
  }
  return all;
}

struct Outcome {
  int found = 0, paired = 0;
  double smallest_stated = 1, largest_stated = 0;
};

/// Of so many experiments.
Outcome run(int experiments, double bias, bool cancels, const Noise& noise, const Goal& goal) {
  const ThreadLimit one(1);  // tasks are too small for more
  Outcome outcome;
  std::uint64_t seed = 0;
  for (int i = 0; i < experiments; ++i) {
    const Draw draw = draw_of(estimators(bias, cancels), noise);
    Goal reference_goal = goal;
    reference_goal.bias *= std::sqrt(test::kReferenceShare);
    reference_goal.most_bias *= std::sqrt(test::kReferenceShare);
    Pool reference({Arm{}}, kPixels, draw, nullptr, seed);
    reference.measure(reference_goal);
    Pool pool(four_arms(), kPixels, draw, &reference, seed);
    pool.measure(goal);
    const Pooled all = pool.pooled();
    outcome.found += static_cast<int>(std::abs(all.t()) >= goal.limit(all.freedom));
    outcome.paired += static_cast<int>(pool.paired());
    outcome.smallest_stated = std::min(outcome.smallest_stated, pool.detected_bias(goal));
    outcome.largest_stated = std::max(outcome.largest_stated, pool.detected_bias(goal));
  }
  std::printf("%d of %d found, %d by pairs, states %.3f to %.3f %%\n", outcome.found, experiments,
              outcome.paired, 100 * outcome.smallest_stated, 100 * outcome.largest_stated);
  return outcome;
}

/// A stated rate of 1 % gives more than 22 alarms in 1000 experiments with a chance of 2e-4 (binomial).
TEST(Pool, CriesWolfNoMoreThanStated) {
  const Goal goal{.bias = 0.01, .false_alarm = 0.01, .most_bias = 0.01};
  for (const bool cancels : {false, true}) {
    for (const Noise& noise : {Noise(normal), Noise(skew)}) {
      const Outcome o = run(1000, 0, cancels, noise, goal);
      EXPECT_LE(o.found, 22);
      EXPECT_EQ(o.paired, cancels ? 1000 : 0);
      EXPECT_LE(o.largest_stated, goal.bias);
    }
  }
}

/// As the agreement tests ask: 0.1 %, by one of 91 tests of a family with a rate of 1e-3. Of 400 experiments
/// 340 or more find it at a power of 0.9, but with a chance of 1e-3 (binomial).
TEST(Pool, FindsTheBiasThatItStates) {
  const Goal goal{.bias = 0.001, .false_alarm = 1e-3, .tests = 91, .most_bias = 0.001};
  for (const bool cancels : {false, true}) {
    for (const double sign : {1.0, -1.0}) {
      const Outcome o = run(400, sign * goal.bias, cancels, normal, goal);
      EXPECT_GE(o.found, 340);
      EXPECT_LE(o.largest_stated, goal.bias);
    }
  }
}

/// A single arm of few samples, whose renderings have seldom met what is rare: 10 samples of 400 a rendering
/// of the image are expected. Half of its family are pooled with it, so that the family's noise is known
/// better.
TEST(Pool, DoesNotCryWolfWhereNoiseIsRare) {
  const Goal goal{.bias = 0.01, .false_alarm = 0.01, .most_cost = 20'000};
  std::vector<Synthetic> all{{1, 0.3, 0}};
  for (int i = 1; i <= 8; ++i) all.push_back({1, 20, 0});
  const ThreadLimit one(1);
  std::uint64_t seed = 0;
  int alarms = 0, careless_alarms = 0;
  for (int i = 0; i < 1000; ++i) {
    Pool reference({Arm{}}, kPixels, draw_of(all, normal), nullptr, seed);
    reference.measure(goal);
    Pool pool(four_arms(), kPixels, draw_of(all, rare), &reference, seed);
    pool.measure(goal);
    const std::vector<std::size_t> block{0, 1, 2, 3};
    const auto first = [](std::size_t arm) { return arm == 0; };
    const Pooled cautious = pool.cautiously_pooled(block, first), careless = pool.pooled(block, first);
    alarms += static_cast<int>(std::abs(cautious.t()) >= goal.limit(cautious.freedom));
    careless_alarms += static_cast<int>(std::abs(careless.t()) >= goal.limit(careless.freedom));
  }
  std::printf("%d alarms, %d without care\n", alarms, careless_alarms);
  EXPECT_LE(alarms, 22);
  EXPECT_GT(careless_alarms, 22) << "this noise does not show what it is for";
}

}  // namespace
}  // namespace lemma
