#include "tests/support/pool.h"

#include <algorithm>
#include <bit>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "src/core/parallel.h"
#include "tests/support/statistics.h"

namespace lemma::test {
namespace {

constexpr std::uint32_t kRenderings = 16;  // of each arm at least
constexpr double kPilotSpp = 4;            // of an arm of cost 1
constexpr double kTrial = 0.125;           // of the work of the rendering that is tested
constexpr double kEvenShare = 0.1;         // of the work, for all arms alike
constexpr double kFirstPart = 0.9;         // of the work that the trial says; what lacks is added
constexpr double kExpectedFreedom = 300;

/// The variance of a difference does not trust that two estimators err alike beyond a correlation of 0.995:
/// where they do the same but for rare samples, a few seeds may have met none of these.
constexpr double kLeastPairNoise = 0.01;

constexpr double kLeastFamilyNoise = 0.3;  // see cautiously_pooled()

/// The variance of what is added up, and its degrees of freedom by Welch and Satterthwaite.
class VarianceSum {
 public:
  void add(double variance, double freedom, double cautious_freedom) {
    variance_ += variance;
    quartic_ += variance * variance / freedom;
    cautious_quartic_ += variance * variance / cautious_freedom;
  }

  [[nodiscard]] Pooled result(double difference) const {
    const double square = variance_ * variance_;
    return {difference, std::sqrt(variance_), square / quartic_, square / cautious_quartic_};
  }

 private:
  double variance_ = 0, quartic_ = 0, cautious_quartic_ = 0;
};

std::uint32_t power_of_two(double at_most) {
  return std::bit_floor(static_cast<std::uint32_t>(std::max(at_most, 1.0)));
}

}  // namespace

void PixelValues::add(const std::vector<double>& pixels) {
  values_.resize(pixels.size());
  for (std::size_t p = 0; p < pixels.size(); ++p) values_[p].push_back(pixels[p]);
}

Pooled PixelValues::mean(std::span<const std::size_t> pixels) const {
  const auto count = static_cast<double>(pixels.size()), freedom = static_cast<double>(renderings()) - 1;
  double sum = 0, variance = 0, quartic = 0;
  for (const std::size_t p : pixels) {
    const Estimate e = estimate(values_[p]);
    const double v = e.standard_error * e.standard_error;
    sum += e.mean, variance += v, quartic += v * v / freedom;
  }
  return {sum / count, std::sqrt(variance) / count, quartic > 0 ? variance * variance / quartic : freedom,
          freedom};
}

double Goal::limit(double freedom) const {
  return t_limit(false_alarm, tests, freedom);
}

double Goal::detectable(double freedom) const {
  return limit(freedom) + boost::math::quantile(boost::math::students_t(freedom), kPower);
}

Pool::Pool(std::vector<Arm> arms, std::size_t pixels, Draw draw, const Pool* reference,
           std::uint64_t& next_seed)
    : arms_(std::move(arms)),
      states_(arms_.size()),
      pixels_(pixels),
      draw_(std::move(draw)),
      reference_(reference),
      next_seed_(next_seed) {
  std::iota(pixels_.begin(), pixels_.end(), std::size_t{0});
}

void Pool::measure(const Goal& goal) {
  constexpr int kMostTurns = 10;
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    states_[i] = {.spp = power_of_two(kPilotSpp / arms_[i].cost), .renderings = kRenderings};
  }
  render(reference_ != nullptr);
  learn_noise();
  choose_pairs(goal);
  const double most = goal.most_cost / static_cast<double>(pixels_.size());
  allot(kTrial * std::min(work_for(wanted_variance(goal)), most));
  render(paired_);
  learn_noise();
  allot(std::min(kFirstPart * work_for(wanted_variance(goal)), most));
  render(paired_);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const double excess = detected_bias(goal) / goal.most_bias;
    if (excess <= 1) break;
    render_more(excess * excess);
  }
}

/// What each arm lacks until it has been rendered as often as its state says.
void Pool::render(bool with_partners) {
  struct Task {
    std::size_t arm = 0;
    std::uint64_t seed = 0;
    std::vector<double> values = {}, differences = {};
  };
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    for (std::size_t k = states_[i].values.renderings(); k < states_[i].renderings; ++k) {
      tasks.push_back({.arm = i, .seed = next_seed_++});
    }
  }
  parallel_for(tasks.size(), [&](std::size_t t) {
    Task& task = tasks[t];
    const Arm& arm = arms_[task.arm];
    const std::uint32_t spp = states_[task.arm].spp;
    task.values = draw_(arm.estimator, spp, task.seed);
    if (!with_partners) return;
    task.differences = draw_(arm.partner, spp, task.seed);
    for (std::size_t p = 0; p < task.values.size(); ++p) {
      task.differences[p] = task.values[p] - task.differences[p];
    }
  });
  for (const Task& task : tasks) {
    states_[task.arm].values.add(task.values);
    if (with_partners) states_[task.arm].differences.add(task.differences);
  }
}

/// Averages over the arms of a kind: each alone would be known from a few seeds only.
void Pool::learn_noise() {
  constexpr double kLeastNoise = 1e-6;  // where a few samples are all alike
  const double least = kLeastNoise * mean() * mean();
  const auto of_one_sample = [&](const State& s, const PixelValues& values) {
    return std::pow(values.mean(pixels_).standard_error, 2) * s.spp * s.renderings;
  };
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    double noise = 0, pair_noise = 0, count = 0;
    for (std::size_t j = 0; j < arms_.size(); ++j) {
      if (arms_[j].kind != arms_[i].kind) continue;
      ++count, noise += of_one_sample(states_[j], states_[j].values);
      if (!states_[j].differences.empty()) pair_noise += of_one_sample(states_[j], states_[j].differences);
    }
    states_[i].noise = std::max(noise / count, least);
    states_[i].pair_noise = std::max(pair_noise / count, kLeastPairNoise * states_[i].noise);
  }
}

double Pool::noise(std::size_t arm) const {
  return paired_ ? states_[arm].pair_noise : states_[arm].noise;
}

/// By pairs where that clearly takes less work: few samples of heavy tails look alike.
void Pool::choose_pairs(const Goal& goal) {
  constexpr double kClearlyLess = 0.5;
  if (reference_ == nullptr) return;
  const double against_reference = work_for(wanted_variance(goal));
  paired_ = true;
  paired_ = work_for(wanted_variance(goal)) < kClearlyLess * against_reference;
}

double Pool::wanted_variance(const Goal& goal) const {
  const double variance = std::pow(goal.bias * mean() / goal.detectable(kExpectedFreedom), 2);
  return reference_ == nullptr || paired_ ? variance : (1 - kReferenceShare) * variance;
}

/// @param work  samples a pixel x cost, of all arms
double Pool::samples_for(std::size_t arm, double work) const {
  double worth = 0;  // of all: cost x 1 / (variance x cost)
  for (std::size_t i = 0; i < arms_.size(); ++i) worth += 1 / noise(i);
  const double by_worth = 1 / (noise(arm) * cost(arm)) / worth,
               even = 1 / (static_cast<double>(arms_.size()) * cost(arm));
  return work * ((1 - kEvenShare) * by_worth + kEvenShare * even);
}

/// Inverse variances add up, and all of them grow with the work.
double Pool::work_for(double variance) const {
  double inverse_variance = 0;
  for (std::size_t i = 0; i < arms_.size(); ++i) inverse_variance += samples_for(i, 1) / noise(i);
  return 1 / (variance * inverse_variance);
}

/// As powers of two, at which Sobol's points are best, and the rest by more renderings.
void Pool::allot(double work) {
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    State& s = states_[i];
    const double samples = samples_for(i, work);
    s.spp = std::max(power_of_two(samples / kRenderings), power_of_two(kPilotSpp / arms_[i].cost));
    s.renderings = std::max(kRenderings, static_cast<std::uint32_t>(std::ceil(samples / s.spp)));
    s.weight = s.spp * s.renderings / noise(i);
    s.values.clear();
    s.differences.clear();
  }
}

void Pool::render_more(double factor) {
  for (State& s : states_) s.renderings = static_cast<std::uint32_t>(std::ceil(s.renderings * factor));
  render(paired_);
}

double Pool::mean_spp() const {
  double sum = 0;
  for (const State& s : states_) sum += s.spp * s.renderings;
  return sum / static_cast<double>(states_.size());
}

double Pool::mean() const {
  if (reference_ != nullptr) return reference_->mean();
  double weights = 0, sum = 0;
  for (const State& s : states_) {
    weights += s.weight, sum += s.weight * s.values.mean(pixels_).difference;
  }
  return sum / weights;
}

/// Of one arm, by pairs or of its own mean, with the least that its noise counts as.
Pooled Pool::difference(std::size_t arm, std::span<const std::size_t> pixels) const {
  const State& s = states_[arm];
  const Pooled own = s.values.mean(pixels);
  if (!paired_) return own;
  Pooled found = s.differences.mean(pixels);
  found.standard_error = std::max(found.standard_error, std::sqrt(kLeastPairNoise) * own.standard_error);
  return found;
}

Pooled Pool::pooled(std::span<const std::size_t> pixels, const std::function<bool(std::size_t)>& counts,
                    const Variance& least) const {
  double weights = 0, sum = 0;
  for (std::size_t i = 0; i < arms_.size(); ++i) weights += counts(i) ? states_[i].weight : 0;
  VarianceSum variance;
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    if (!counts(i)) continue;
    const Pooled d = difference(i, pixels);
    const double part = states_[i].weight / weights;
    sum += part * d.difference;
    variance.add(part * part * std::max(d.standard_error * d.standard_error, least(i)), d.freedom,
                 d.cautious_freedom);
  }
  if (paired_ || reference_ == nullptr) return variance.result(sum);
  const Pooled reference = reference_->pooled(pixels, [](std::size_t) { return true; });
  variance.add(reference.standard_error * reference.standard_error, reference.freedom,
               reference.cautious_freedom);
  return variance.result(sum - reference.difference);
}

Pooled Pool::pooled(std::span<const std::size_t> pixels,
                    const std::function<bool(std::size_t)>& counts) const {
  return pooled(pixels, counts, [](std::size_t) { return 0.0; });
}

Pooled Pool::cautiously_pooled(std::span<const std::size_t> pixels,
                               const std::function<bool(std::size_t)>& counts) const {
  const auto samples = [&](std::size_t i) { return 1.0 * states_[i].spp * states_[i].renderings; };
  const double part = reference_->pooled(pixels, [](std::size_t) { return true; }).difference / mean(),
               scale = part * part * static_cast<double>(pixels_.size()) / static_cast<double>(pixels.size());
  Pooled found = pooled(pixels, counts, [&](std::size_t arm) {
    double noise = 0, count = 0;
    for (std::size_t j = 0; j < arms_.size(); ++j) {
      if (arms_[j].family != arms_[arm].family) continue;
      ++count, noise += std::pow(difference(j, pixels_).standard_error, 2) * samples(j);
    }
    return kLeastFamilyNoise * scale * noise / count / samples(arm);
  });
  found.freedom = found.cautious_freedom;
  return found;
}

Pooled Pool::pooled() const {
  return pooled(pixels_, [](std::size_t) { return true; });
}

double Pool::detected_bias(const Goal& goal) const {
  const Pooled all = pooled();
  return goal.detectable(all.freedom) * all.standard_error / mean();
}

}  // namespace lemma::test
