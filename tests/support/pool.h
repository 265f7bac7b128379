#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace lemma::test {

// Means of noisy estimators, pooled, and sampled until a bias of a given size would be found.

/// Renders an estimator with so many samples a pixel: the mean of each pixel. The noise of different pixels
/// and seeds is independent, that of two estimators with the same seed need not be. Called by several
/// threads.
using Draw = std::function<std::vector<double>(std::size_t estimator, std::uint32_t spp, std::uint64_t seed)>;

/// An estimated difference of means, or a mean.
struct Pooled {
  double difference = 0, standard_error = 0;
  double freedom = 0;           // of the standard error, if the pixels' noise is nearly normal
  double cautious_freedom = 0;  // as if all pixels of a rendering told no more than one

  [[nodiscard]] double t() const { return difference / standard_error; }
};

/// The values of each pixel in independent renderings.
class PixelValues {
 public:
  void add(const std::vector<double>& pixels);
  void clear() { values_.clear(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] std::size_t renderings() const { return values_.empty() ? 0 : values_.front().size(); }

  /// The mean over these pixels. Its variance is that of its pixels, added up, which has the more degrees of
  /// freedom the more pixels there are (Welch, Satterthwaite).
  [[nodiscard]] Pooled mean(std::span<const std::size_t> pixels) const;

 private:
  std::vector<std::vector<double>> values_;  // of each pixel
};

/// An estimator among others that should have the same mean.
struct Arm {
  std::size_t estimator = 0, partner = 0;  // the partner is what it may be compared with by pairs
  double cost = 1;                         // of a sample; that of a partner is the same
  std::size_t kind = 0;                    // arms of one kind are alike in noise
  std::size_t family = 0;                  // those of one family within a factor of 10
};

/// What a test shall find: a bias of this part of the mean, with the probability kPower.
struct Goal {
  double bias = 0;
  double false_alarm = 0;  // of all tests of the family together
  int tests = 1;
  double most_cost = std::numeric_limits<double>::infinity();  // samples of all pixels x their cost, but ...
  double most_bias = std::numeric_limits<double>::infinity();  // ... to find this one, whatever it costs

  /// That |t| stays below with this probability when there is no bias.
  [[nodiscard]] double limit(double freedom) const;

  /// The bias that is found with the probability kPower, in standard errors.
  [[nodiscard]] double detectable(double freedom) const;
};

/// Chance that a bias of the size that is stated as detectable is found.
inline constexpr double kPower = 0.9;

/// Part of a test's variance that may be the reference's.
inline constexpr double kReferenceShare = 0.25;

/// The difference of several arms, weighted, from what they are compared with: each from its partner, drawn
/// with the same random numbers, so that what both do with them alike cancels; or all from a reference that
/// many pools share, which takes half of the samples where nothing cancels. Which it is a short rendering
/// tells, by the samples that either would take.
///
/// Arms are weighted by the inverse of their variance, and get samples by what these are worth, 1 / (variance
/// x cost), but for a tenth of the work, which all share alike. Both follow from a rendering with other seeds
/// that is not used otherwise, so that weights and values are independent. A tested rendering that turns out
/// to be too noisy is continued. It is its variance that decides so, not its mean, which are nearly
/// independent; tests/measure/pool_test.cpp counts the false alarms.
class Pool {
 public:
  /// @param reference  nullptr for a pool that is a mean, not a difference
  /// @param next_seed  of `draw`, counted up
  Pool(std::vector<Arm> arms, std::size_t pixels, Draw draw, const Pool* reference, std::uint64_t& next_seed);

  void measure(const Goal& goal);

  [[nodiscard]] std::span<const Arm> arms() const { return arms_; }
  [[nodiscard]] std::span<const std::size_t> pixels() const { return pixels_; }  // all
  [[nodiscard]] bool paired() const { return paired_; }
  [[nodiscard]] double mean_spp() const;  // over the arms

  /// Of all pixels, by the reference where there is one.
  [[nodiscard]] double mean() const;

  /// The difference over some of the pixels, of some of the arms.
  [[nodiscard]] Pooled pooled(std::span<const std::size_t> pixels,
                              const std::function<bool(std::size_t arm)>& counts) const;
  [[nodiscard]] Pooled pooled() const;  // of all

  /// The same for few arms, whose noise may lie in rare bright samples that none of their renderings met
  /// there: the relative variance of a sample counts as 0.3 of that of the arm's family in the whole image at
  /// least, and each rendering as one value.
  [[nodiscard]] Pooled cautiously_pooled(std::span<const std::size_t> pixels,
                                         const std::function<bool(std::size_t arm)>& counts) const;

  /// Part of the mean.
  [[nodiscard]] double detected_bias(const Goal& goal) const;

 private:
  struct State {
    std::uint32_t spp = 1, renderings = 0;
    double noise = 0, pair_noise = 0;  // variance of the mean of the image with one sample a pixel
    double weight = 1;
    PixelValues values = {}, differences = {};
  };

  using Variance = std::function<double(std::size_t arm)>;

  [[nodiscard]] Pooled pooled(std::span<const std::size_t> pixels,
                              const std::function<bool(std::size_t)>& counts, const Variance& least) const;
  [[nodiscard]] Pooled difference(std::size_t arm, std::span<const std::size_t> pixels) const;
  void render(bool with_partners);
  void learn_noise();
  void allot(double work);
  [[nodiscard]] double samples_for(std::size_t arm, double work) const;
  [[nodiscard]] double work_for(double variance) const;
  [[nodiscard]] double noise(std::size_t arm) const;
  [[nodiscard]] double cost(std::size_t arm) const { return arms_[arm].cost * (paired_ ? 2 : 1); }
  [[nodiscard]] double wanted_variance(const Goal& goal) const;
  void choose_pairs(const Goal& goal);
  void render_more(double factor);

  std::vector<Arm> arms_;
  std::vector<State> states_;
  std::vector<std::size_t> pixels_;
  Draw draw_;
  const Pool* reference_;
  std::uint64_t& next_seed_;
  bool paired_ = false;
};

}  // namespace lemma::test
