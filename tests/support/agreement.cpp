#include "tests/support/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <optional>
#include <ranges>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/combinations.h"
#include "tests/support/pool.h"

namespace lemma::test {
namespace {

constexpr int kBlock = 2;
constexpr std::size_t kUsualFraction = 4, kFewComparisons = 16;  // more are a fraction of the product
constexpr int kKinds = 5;                                        // of tests, which share the false alarms
constexpr double kWantedBias = 0.001, kUsualBias = 0.002, kMostUsualBias = 0.05;
constexpr double kUsualCost = 250'000;  // of a choice at most: samples x cost, besides what finds their noise
constexpr std::uint64_t kSeedsOfChoice = std::uint64_t{1} << 32;  // each has its own, whichever are asked for
constexpr double kReferenceCosts = 3;                             // of the reference, in those of a choice

/// What LEMMA_AGREEMENT asks for.
std::optional<double> asked_bias() {
  const char* percent = std::getenv("LEMMA_AGREEMENT");
  if (percent == nullptr) return std::nullopt;
  const double bias = std::strtod(percent, nullptr) / 100;
  if (!(bias > 0)) throw std::invalid_argument("LEMMA_AGREEMENT is no percentage above 0");
  return bias;
}

/// By LEMMA_AGREEMENT_CHOICES: parts of names, with commas between them.
bool is_asked_for(const Choice& choice) {
  const char* parts = std::getenv("LEMMA_AGREEMENT_CHOICES");
  if (parts == nullptr) return true;
  const std::string name = name_of(choice);
  return std::ranges::any_of(std::views::split(std::string_view(parts), ','), [&](const auto& part) {
    return name.find(std::string_view(part.begin(), part.end())) != std::string::npos;
  });
}

/// Of all threads [s].
double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Tests of one kind. The limit of each depends on its degrees of freedom and on how many there are.
class Tests {
 public:
  void add(std::string name, const Pooled& found) { tests_.push_back({std::move(name), found}); }

  /// Prints what they detect and how near to its limit the nearest came.
  void expect(const char* kind, double false_alarm, double mean) const {
    const Goal goal{.false_alarm = false_alarm, .tests = static_cast<int>(tests_.size())};
    std::vector<double> seen;
    const std::pair<std::string, Pooled>* nearest = nullptr;
    double ratio = -1;
    for (const auto& test : tests_) {
      const Pooled& found = test.second;
      const double most = goal.limit(found.freedom);
      EXPECT_LT(std::abs(found.t()), most)
          << kind << ", " << test.first << ": " << found.difference << " +- " << found.standard_error;
      seen.push_back(goal.detectable(found.freedom) * found.standard_error / mean);
      if (std::abs(found.t()) / most > ratio) ratio = std::abs(found.t()) / most, nearest = &test;
    }
    std::ranges::sort(seen);
    std::printf("%5zu %-28s detect %.3f to %.3f %%, half of them %.3f %%; nearest: t %.2f of %.2f, %s\n",
                tests_.size(), kind, 100 * seen.front(), 100 * seen.back(), 100 * seen[seen.size() / 2],
                nearest->second.t(), goal.limit(nearest->second.freedom), nearest->first.c_str());
  }

 private:
  std::vector<std::pair<std::string, Pooled>> tests_;
};

/// All comparisons of the choices of one scene.
class Agreement {
 public:
  Agreement(const AgreementCase& c, int scenes_of_family)
      : case_(c),
        false_alarm_(kFalseAlarm / scenes_of_family / kKinds),
        renderer_(c.scene),
        combinations_(all_combinations(c.scene, c.touches_light)),
        blocks_(blocks_of(c.scene.view.width, c.scene.view.height, kBlock)) {}

  void run() {
    const std::vector<Choice> choices = choices_to_compare();
    const double start = processor_time();
    Goal goal{.bias = asked_bias().value_or(kUsualBias),
              .false_alarm = false_alarm_,
              .tests = static_cast<int>(choices.size())};
    goal.most_bias = asked_bias().value_or(kMostUsualBias);
    if (!asked_bias()) goal.most_cost = kUsualCost;
    Goal reference_goal = goal;
    reference_goal.bias *= std::sqrt(kReferenceShare);
    reference_goal.most_bias *= std::sqrt(kReferenceShare);
    reference_goal.most_cost *= kReferenceCosts;
    const std::size_t first = index_of(Combination{});
    Pool reference = pool({{.estimator = first, .partner = first}}, nullptr);
    reference.measure(reference_goal);
    std::printf("reference: %.6f, %.0f spp, %.0f s; its noise alone would show %.4f %%\n", reference.mean(),
                reference.mean_spp(), processor_time() - start, 100 * reference.detected_bias(goal));
    std::fflush(stdout);
    double compared = 0;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      next_seed_ = (i + 1) * kSeedsOfChoice;
      if (!is_asked_for(choices[i])) continue;
      compare(choices[i], reference, goal);
      ++compared;
    }
    if (compared == 0) return;
    const double false_alarm = false_alarm_ * compared / static_cast<double>(choices.size());
    std::printf("%.0f s in all; for 0.1 %% about %.0f s, with the whole product more\n",
                processor_time() - start, seconds_wanted_);
    choice_tests_.expect("choices", false_alarm, reference.mean());
    block_tests_.expect("choices, blocks", false_alarm, reference.mean());
    pair_tests_.expect("pairs of choices", false_alarm, reference.mean());
    combination_tests_.expect("combinations", false_alarm, reference.mean());
    combination_block_tests_.expect("combinations, blocks", false_alarm, reference.mean());
  }

 private:
  [[nodiscard]] std::size_t index_of(const Combination& c) const {
    return static_cast<std::size_t>(std::ranges::find(combinations_, c) - combinations_.begin());
  }

  std::vector<Choice> choices_to_compare() const {
    std::vector<Choice> found;
    for (std::size_t o = 0; o < kOptions; ++o) {
      for (std::size_t i = 1; i < options()[o].choices.size(); ++i) {
        if (!arms_of({o, i}).empty()) found.push_back({o, i});
      }
    }
    return found;
  }

  std::vector<Arm> arms_of(const Choice& choice) const {
    std::vector<Arm> arms;
    for (std::size_t i = 0; i < combinations_.size(); ++i) {
      const Combination& c = combinations_[i];
      if (c[choice.option] != choice.index) continue;
      const std::size_t first = index_of(with(c, {choice.option, 0}));
      if (first == combinations_.size()) continue;
      arms.push_back({.estimator = i,
                      .partner = first,
                      .cost = std::max(cost(c, case_.scene), cost(combinations_[first], case_.scene)),
                      .kind = kind_of_noise(c),
                      .family = family_of_noise(c)});
    }
    if (!asked_bias() && arms.size() > kFewComparisons) {
      std::erase_if(arms, [&](const Arm& arm) {
        const Combination& first = combinations_[arm.partner];
        return std::accumulate(first.begin(), first.end(), std::size_t{0}) % kUsualFraction != 0;
      });
    }
    return arms;
  }

  Pool pool(std::vector<Arm> arms, const Pool* reference) {
    const auto draw = [this](std::size_t estimator, std::uint32_t spp, std::uint64_t seed) {
      return renderer_.pixels(combinations_[estimator], spp, seed);
    };
    return {std::move(arms), static_cast<std::size_t>(case_.scene.view.width * case_.scene.view.height), draw,
            reference, next_seed_};
  }

  void compare(const Choice& choice, const Pool& reference, const Goal& goal) {
    const double start = processor_time();
    Pool found = pool(arms_of(choice), &reference);
    found.measure(goal);
    const double seconds = processor_time() - start, bias = found.detected_bias(goal);
    const double seconds_wanted = seconds * std::pow(bias / kWantedBias, 2);
    seconds_wanted_ += seconds_wanted;
    const Pooled all = found.pooled();
    std::printf(
        "%-36s %3zu x %9.0f spp, %-9s  %+.4f %% +- %.4f %%  t %5.2f of %.2f  detects %.4f %%  "
        "%.1f s; for 0.1 %% about %.0f s\n",
        name_of(choice).c_str(), found.arms().size(), found.mean_spp(),
        found.paired() ? "pairs" : "reference", 100 * all.difference / found.mean(),
        100 * all.standard_error / found.mean(), all.t(), goal.limit(all.freedom), 100 * bias, seconds,
        seconds_wanted);
    std::fflush(stdout);
    EXPECT_LE(bias, goal.most_bias) << name_of(choice) << " is too noisy";
    choice_tests_.add(name_of(choice), all);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      block_tests_.add(name_of(choice) + ", block " + std::to_string(b),
                       found.pooled(blocks_[b], [](std::size_t) { return true; }));
    }
    add_pairs(choice, found);
    add_combinations(choice, found);
  }

  [[nodiscard]] const Combination& combination(const Pool& found, std::size_t arm) const {
    return combinations_[found.arms()[arm].estimator];
  }

  void add_pairs(const Choice& choice, const Pool& found) {
    for (std::size_t o = 0; o < kOptions; ++o) {
      for (std::size_t i = 0; i < options()[o].choices.size() && o != choice.option; ++i) {
        const auto has = [&](std::size_t arm) { return combination(found, arm)[o] == i; };
        bool any = false;
        for (std::size_t arm = 0; arm < found.arms().size(); ++arm) any = any || has(arm);
        if (!any) continue;
        pair_tests_.add(name_of(choice) + ", with " + name_of(Choice{o, i}),
                        found.cautiously_pooled(found.pixels(), has));
      }
    }
  }

  void add_combinations(const Choice& choice, const Pool& found) {
    for (std::size_t arm = 0; arm < found.arms().size(); ++arm) {
      const std::string name = name_of(choice) + " in " + name_of(combination(found, arm));
      const auto this_one = [&](std::size_t other) { return other == arm; };
      combination_tests_.add(name, found.cautiously_pooled(found.pixels(), this_one));
      for (std::size_t b = 0; b < blocks_.size(); ++b) {
        combination_block_tests_.add(name + ", block " + std::to_string(b),
                                     found.cautiously_pooled(blocks_[b], this_one));
      }
    }
  }

  const AgreementCase& case_;
  double false_alarm_;
  CombinationRenderer renderer_;
  std::vector<Combination> combinations_;
  std::vector<std::vector<std::size_t>> blocks_;  // the pixels of each
  std::uint64_t next_seed_ = 0;
  double seconds_wanted_ = 0;
  Tests choice_tests_, block_tests_, pair_tests_, combination_tests_, combination_block_tests_;
};

}  // namespace

void expect_agreement(const AgreementCase& c, int scenes_of_family) {
  Agreement(c, scenes_of_family).run();
}

}  // namespace lemma::test
