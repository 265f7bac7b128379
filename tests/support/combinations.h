#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/images.h"

namespace lemma::test {

// The options that must not change the mean of an image, and their combinations.

inline constexpr std::size_t kOptions = 6;

struct Option {
  std::string_view name;
  std::vector<std::string_view> choices;  // the first is what the others are compared with
};

/// weights (and integrator), lights, BRDF sampling, roulette, sampler, accelerator. Brute force is not among
/// the last: it gives the same pixels as the others (tests/parity).
[[nodiscard]] std::span<const Option, kOptions> options();

/// A choice of one option: "lights power".
struct Choice {
  std::size_t option = 0, index = 0;
};

/// The index of the choice of each option.
using Combination = std::array<std::size_t, kOptions>;

[[nodiscard]] Combination with(Combination combination, const Choice& choice);

[[nodiscard]] std::string name_of(const Choice& choice);
[[nodiscard]] std::string name_of(const Combination& combination);

/// Whether the combination is one of its own and has a finite variance: without light samples there is no
/// light sampling to choose, without Phong's lobes no BRDF sampling. See AgreementCase::touches_light.
[[nodiscard]] bool is_possible(const Combination& combination, const Scene& scene, bool touches_light);

[[nodiscard]] std::vector<Combination> all_combinations(const Scene& scene, bool touches_light);

/// Of a sample, about, in microseconds: some strategies visit every emitter at every vertex.
[[nodiscard]] double cost(const Combination& combination, const Scene& scene);

/// The same for combinations that are alike in noise: all but accelerator and BRDF sampling are the same.
[[nodiscard]] std::size_t kind_of_noise(const Combination& combination);

/// The same for combinations with the same weights and lights, which decide the noise above all.
[[nodiscard]] std::size_t family_of_noise(const Combination& combination);

/// The pixels of each block of so many pixels squared, row by row.
[[nodiscard]] std::vector<std::vector<std::size_t>> blocks_of(int width, int height, int block);

/// Renders combinations for a scene. May be used by several threads.
class CombinationRenderer {
 public:
  explicit CombinationRenderer(const Scene& scene);

  /// The mean over the channels of each pixel.
  [[nodiscard]] std::vector<double> pixels(const Combination& combination, std::uint32_t spp,
                                           std::uint64_t seed) const;

 private:
  std::vector<Scene> scenes_;  // one for each BRDF sampling
  std::vector<std::unique_ptr<const LightSampler>> lights_;
  std::vector<std::unique_ptr<const Accelerator>> accelerators_;
};

}  // namespace lemma::test
