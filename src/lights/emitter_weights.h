#pragma once

#include "src/lights/light_sampler.h"
#include "src/lights/weigh_emitters.h"

namespace lemma {

/// A choice among all emitters with probability ~ their weight as seen from a point. Weights are in float32
/// and serve as probabilities only, so their error makes no bias; choice and probability use the same
/// function and see the same bits.
class EmitterWeights {
 public:
  enum class Measure { solid_angle, projected_solid_angle };  // which is multiplied by luminance

  EmitterWeights(std::span<const Emitter> emitters, Measure measure);

  /// Makes room for what prepare() finds.
  void reserve(LightQuery& at) const { at.running_weights.reserve(blocks_.size()); }

  /// Finds the sums that the choice and its probability need.
  void prepare(LightQuery& at) const;

  struct Choice {
    std::uint32_t emitter;
    double pmf;
  };

  /// Draws an emitter for u uniform in [0, 1); nothing if all weights are 0. Never one of weight 0.
  [[nodiscard]] std::optional<Choice> choose(const LightQuery& at, double u) const;

  /// The probability that choose() returns the emitter.
  [[nodiscard]] double pmf(const LightQuery& at, std::uint32_t emitter) const;

 private:
  [[nodiscard]] EmitterBlock::Values weigh(std::size_t block, const LightQuery& at) const;

  std::vector<EmitterBlock> blocks_;
  WeighEmitters::Function weigh_;
};

}  // namespace lemma
