#include "tests/support/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "src/core/parallel.h"
#include "tests/support/combinations.h"
#include "tests/support/images.h"

namespace lemma::test {
namespace {

constexpr std::uint64_t kSeeds = 16, kFirstSeeds = 8;
constexpr int kBlock = 4;
constexpr std::size_t kUsualFraction = 4, kFewComparisons = 16;  // more are a fraction of the product
constexpr double kFirstSpp = 2;
constexpr double kLeastSpp = 4;  // many enough for sums to be nearly normal
constexpr int kKinds = 5;        // of tests, which share the false alarms

/// What LEMMA_AGREEMENT asks for.
std::optional<double> asked_bias() {
  const char* percent = std::getenv("LEMMA_AGREEMENT");
  if (percent == nullptr) return std::nullopt;
  const double bias = std::strtod(percent, nullptr) / 100;
  if (!(bias > 0)) throw std::invalid_argument("LEMMA_AGREEMENT is no percentage above 0");
  return bias;
}

/// A combination against that with the first choice of one option.
struct Comparison {
  Combination combination;
  double cost = 1;    // of a sample of the costlier, about
  double weight = 1;  // in sums over comparisons
  std::uint32_t spp = 1;
  std::uint32_t first_spp = 1;             // of the combination with the first choice
  std::vector<Estimate> differences = {};  // of the image mean, then of the blocks' [radiance]
  std::vector<Estimate> means = {};        // of the combination itself
  Estimate first_mean = {};                // of the image with the first choice
  double first_part = 1;                   // first_spp / spp

  [[nodiscard]] double variance() const { return std::pow(differences[0].standard_error, 2); }
};

/// The mean of differences, whose standard error does not trust that both err alike beyond a correlation of
/// 0.995: where they do the same but for rare samples, a few seeds may have met none of these.
Estimate careful_estimate(std::span<const double> differences, const Estimate& mean) {
  constexpr double kLeast = 0.1;
  Estimate found = estimate(differences);
  found.standard_error = std::max(found.standard_error, kLeast * mean.standard_error);
  return found;
}

/// A weighted mean of differences.
struct Pooled {
  double difference = 0, standard_error = 0, freedom = 0;

  [[nodiscard]] double t() const { return difference / standard_error; }
};

Pooled pool(std::span<const Comparison> comparisons, std::size_t of,
            const std::function<bool(const Comparison&)>& counts) {
  double weights = 0, sum = 0, variance = 0, quartic = 0;
  for (const Comparison& c : comparisons) {
    if (!counts(c)) continue;
    const Estimate& d = c.differences[of];
    const double part = std::pow(c.weight * d.standard_error, 2);
    weights += c.weight, sum += c.weight * d.mean, variance += part;
    quartic += part * part / (d.count - 1);
  }
  return {sum / weights, std::sqrt(variance) / weights, variance * variance / quartic};
}

/// Of a bias that is found with probability kPower, as a multiple of the standard error.
double detectable(double limit, double freedom) {
  return limit + boost::math::quantile(boost::math::students_t(freedom), kPower);
}

/// Tests of one kind. The limit of each depends on its degrees of freedom and on how many there are.
class Tests {
 public:
  void add(std::string name, const Pooled& found) { tests_.push_back({std::move(name), found}); }

  [[nodiscard]] double limit(const Pooled& found, double false_alarm) const {
    return t_limit(false_alarm, static_cast<int>(tests_.size()), found.freedom);
  }

  /// Prints what they detect and how near to its limit the nearest came.
  void expect(const char* kind, double false_alarm, double mean) const {
    std::vector<double> seen;
    const std::pair<std::string, Pooled>* nearest = nullptr;
    double ratio = -1;
    for (const auto& test : tests_) {
      const Pooled& found = test.second;
      const double most = limit(found, false_alarm);
      EXPECT_LT(std::abs(found.t()), most)
          << kind << ", " << test.first << ": " << found.difference << " +- " << found.standard_error;
      seen.push_back(detectable(most, found.freedom) * found.standard_error / mean);
      if (std::abs(found.t()) / most > ratio) ratio = std::abs(found.t()) / most, nearest = &test;
    }
    std::ranges::sort(seen);
    std::printf("%5zu %-28s detect %.3f to %.3f %%, half of them %.3f %%; nearest: t %.2f of %.2f, %s\n",
                tests_.size(), kind, 100 * seen.front(), 100 * seen.back(), 100 * seen[seen.size() / 2],
                nearest->second.t(), limit(nearest->second, false_alarm), nearest->first.c_str());
  }

 private:
  std::vector<std::pair<std::string, Pooled>> tests_;
};

/// All comparisons of the choices of one scene.
class Agreement {
 public:
  Agreement(const AgreementCase& c, int scenes_of_family)
      : case_(c),
        wanted_bias_(asked_bias().value_or(c.usual_bias)),
        false_alarm_(kFalseAlarm / scenes_of_family / kKinds),
        renderer_(c.scene) {}

  void run() {
    const auto choices = choices_to_compare();
    for (const Choice& choice : choices) compare(choice, static_cast<int>(choices.size()));
    const double mean = mean_ / static_cast<double>(choices.size());
    choices_.expect("choices", false_alarm_, mean);
    blocks_.expect("choices, blocks", false_alarm_, mean);
    pairs_.expect("pairs of choices", false_alarm_, mean);
    combinations_.expect("combinations", false_alarm_, mean);
    combination_blocks_.expect("combinations, blocks", false_alarm_, mean);
  }

 private:
  std::vector<Choice> choices_to_compare() const {
    std::vector<Choice> found;
    for (std::size_t o = 0; o < kOptions; ++o) {
      for (std::size_t i = 1; i < options()[o].choices.size(); ++i) {
        if (!comparisons_of({o, i}).empty()) found.push_back({o, i});
      }
    }
    return found;
  }

  std::vector<Comparison> comparisons_of(const Choice& choice) const {
    std::vector<Comparison> found;
    for (const Combination& c : all_combinations(case_.scene, case_.touches_light)) {
      if (c[choice.option] != choice.index) continue;
      const Combination first = with(c, {choice.option, 0});
      if (!is_possible(first, case_.scene, case_.touches_light)) continue;
      found.push_back({.combination = c, .cost = std::max(cost(c, case_.scene), cost(first, case_.scene))});
    }
    if (!asked_bias() && found.size() > kFewComparisons) {
      std::erase_if(found, [&](const Comparison& c) {
        const Combination first = with(c.combination, {choice.option, 0});
        return std::accumulate(first.begin(), first.end(), std::size_t{0}) % kUsualFraction != 0;
      });
    }
    return found;
  }

  void render(std::vector<Comparison>& comparisons, const Choice& choice, std::uint64_t seeds) {
    parallel_for(comparisons.size(), [&](std::size_t i) {
      Comparison& c = comparisons[i];
      std::vector<std::vector<double>> values, differences;
      std::vector<double> first_values;
      for (std::uint64_t s = 0; s < seeds; ++s) {
        const std::uint64_t seed = next_seed_ + i * seeds + s;
        const auto chosen = renderer_.means(c.combination, c.spp, seed, kBlock);
        const auto first =
            renderer_.means(with(c.combination, {choice.option, 0}), c.first_spp, seed, kBlock);
        first_values.push_back(first[0]);
        values.resize(first.size());
        differences.resize(first.size());
        for (std::size_t b = 0; b < first.size(); ++b) {
          values[b].push_back(chosen[b]);
          differences[b].push_back(chosen[b] - first[b]);
        }
      }
      c.first_mean = estimate(first_values);
      c.means.clear();
      c.differences.clear();
      for (std::size_t b = 0; b < values.size(); ++b) {
        c.means.push_back(estimate(values[b]));
        c.differences.push_back(careful_estimate(differences[b], c.means[b]));
      }
    });
    next_seed_ += comparisons.size() * seeds;
  }

  /// Weights by the inverse variance, and fewer samples for the first choice where its own noise is that
  /// much less that nothing cancels. Both hang on light sampling and weights above all: what few seeds found
  /// is averaged over the other options.
  static void weigh(std::vector<Comparison>& comparisons) {
    constexpr double kLeast = 0.01;  // of the average, so that no noise found is no weight without end
    constexpr double kMuchLess = 0.3;
    double all = 0;
    for (const Comparison& c : comparisons) all += c.variance() / static_cast<double>(comparisons.size());
    for (Comparison& c : comparisons) {
      double sum = 0, count = 0, noise = 0, first_noise = 0;  // of a sample a pixel
      for (const Comparison& other : comparisons) {
        if (!alike_in_noise(c.combination, other.combination)) continue;
        sum += other.variance() * other.spp, ++count;
        noise += std::pow(other.means[0].standard_error, 2) * other.spp;
        first_noise += std::pow(other.first_mean.standard_error, 2) * other.first_spp;
      }
      c.weight = 1 / (sum / count / c.spp + kLeast * all);
      const double ratio = std::sqrt(first_noise / noise);  // at which both err alike for the least cost
      c.first_part = ratio < kMuchLess ? ratio : 1;
    }
  }

  /// Samples so that the bias that the rendering before would detect becomes the one wanted: the fewer, the
  /// costlier and noisier a comparison is, by the root of both.
  /// @param margin  factor for the noise of variances
  void allot_samples(std::vector<Comparison>& comparisons, double bias, std::uint64_t seeds,
                     double margin) const {
    const auto share = [](const Comparison& c) { return std::sqrt(c.weight * c.spp / c.cost); };
    double weights = 0, shares = 0;
    for (const Comparison& c : comparisons) weights += c.weight, shares += c.weight / c.spp * share(c);
    const double factor = margin * std::pow(bias / wanted_bias_, 2) * static_cast<double>(seeds) /
                          static_cast<double>(kSeeds) * weights / shares;
    for (Comparison& c : comparisons) {
      const double before = c.spp, least = kLeastSpp / std::sqrt(c.cost);
      c.spp = static_cast<std::uint32_t>(std::ceil(std::max(factor * share(c), least)));
      c.first_spp = static_cast<std::uint32_t>(std::ceil(c.spp * c.first_part));
      c.weight *= c.spp / before;
    }
  }

  /// Renders until the bias wanted is detected: the samples follow from the rendering before, with other
  /// seeds.
  void compare(const Choice& choice, int choices) {
    constexpr int kMostTurns = 4;
    constexpr double kMargin = 1.3;
    std::vector<Comparison> comparisons = comparisons_of(choice);
    for (Comparison& c : comparisons) {
      c.spp = c.first_spp = static_cast<std::uint32_t>(std::ceil(kFirstSpp / std::sqrt(c.cost)));
    }
    render(comparisons, choice, kFirstSeeds);
    std::uint64_t seeds = kFirstSeeds;
    const double freedom = static_cast<double>(comparisons.size() * kSeeds) / 2;  // expected
    for (int turn = 0; turn < kMostTurns; ++turn) {
      weigh(comparisons);
      allot_samples(comparisons, detected_bias(comparisons, choices, freedom), seeds, kMargin * (turn + 1));
      render(comparisons, choice, kSeeds);
      if (detected_bias(comparisons, choices) <= wanted_bias_) break;
      seeds = kSeeds;
    }
    report(choice, comparisons, choices);
  }

  /// Of the image, in the combinations with this choice, as they are weighted.
  static double mean_of(const std::vector<Comparison>& comparisons) {
    double weights = 0, sum = 0;
    for (const Comparison& c : comparisons) weights += c.weight, sum += c.weight * c.means[0].mean;
    return sum / weights;
  }

  /// By the test of all comparisons of a choice [part of the image mean].
  /// @param freedom  of their variance, at least
  double detected_bias(const std::vector<Comparison>& comparisons, int choices, double freedom = 0) const {
    const Pooled found = pool(comparisons, 0, [](const Comparison&) { return true; });
    freedom = std::max(found.freedom, freedom);
    const double limit = t_limit(false_alarm_, choices, freedom);
    return detectable(limit, freedom) * found.standard_error / mean_of(comparisons);
  }

  void report(const Choice& choice, const std::vector<Comparison>& comparisons, int choices) {
    const auto all = [](const Comparison&) { return true; };
    const double mean = mean_of(comparisons), bias = detected_bias(comparisons, choices);
    mean_ += mean;
    std::uint64_t spp = 0;
    for (const Comparison& c : comparisons) spp += c.spp;
    const Pooled pooled = pool(comparisons, 0, all);
    std::printf("%-36s %3zu x %7.0f spp  %+.4f %% +- %.4f %%  t %5.2f of %.2f  detects %.4f %%\n",
                name_of(choice).c_str(), comparisons.size(),
                static_cast<double>(spp) / static_cast<double>(comparisons.size()),
                100 * pooled.difference / mean, 100 * pooled.standard_error / mean, pooled.t(),
                t_limit(false_alarm_, choices, pooled.freedom), 100 * bias);
    std::fflush(stdout);
    EXPECT_LE(bias, wanted_bias_) << name_of(choice) << " is too noisy";
    choices_.add(name_of(choice), pooled);
    for (std::size_t b = 1; b < comparisons.front().differences.size(); ++b) {
      blocks_.add(name_of(choice) + ", block " + std::to_string(b), pool(comparisons, b, all));
    }
    add_pairs(choice, comparisons);
    add_combinations(choice, comparisons);
  }

  void add_pairs(const Choice& choice, const std::vector<Comparison>& comparisons) {
    for (std::size_t o = 0; o < kOptions; ++o) {
      for (std::size_t i = 0; i < options()[o].choices.size() && o != choice.option; ++i) {
        const auto has = [&](const Comparison& c) { return c.combination[o] == i; };
        if (std::ranges::none_of(comparisons, has)) continue;
        pairs_.add(name_of(choice) + ", with " + name_of(Choice{o, i}), pool(comparisons, 0, has));
      }
    }
  }

  void add_combinations(const Choice& choice, const std::vector<Comparison>& comparisons) {
    for (const Comparison& c : comparisons) {
      const std::string name = name_of(choice) + " in " + name_of(c.combination);
      const auto this_one = [&](const Comparison& other) { return &other == &c; };
      combinations_.add(name, pool(comparisons, 0, this_one));
      for (std::size_t b = 1; b < c.differences.size(); ++b) {
        combination_blocks_.add(name + ", block " + std::to_string(b), pool(comparisons, b, this_one));
      }
    }
  }

  const AgreementCase& case_;
  double wanted_bias_;
  double false_alarm_;
  CombinationRenderer renderer_;
  std::uint64_t next_seed_ = 0;
  double mean_ = 0;
  Tests choices_, blocks_, pairs_, combinations_, combination_blocks_;
};

}  // namespace

void expect_agreement(const AgreementCase& c, int scenes_of_family) {
  Agreement(c, scenes_of_family).run();
}

}  // namespace lemma::test
