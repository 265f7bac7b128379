#pragma once

#include <vector>

#include "src/core/lane_list.h"
#include "src/core/sampler.h"
#include "src/core/wave.h"

namespace lemma {

/// Of each lane a Sampler::ChoicePair.
struct ChoicePairWave {
  Wave<double> x;
  Wave<float> y;
};

/// The random numbers of a wave: a Sampler for each lane, all of one sequence and of samples of one index.
/// The first `count` lanes draw what their samplers would.
class SamplerWave {
 public:
  /// Draws for all lanes with Sequence::sobol, compiled for one instruction set.
  struct Draws {
    /// Of each lane, the state of a Sampler
    struct Keys {
      Wave<std::uint64_t> next;
      Wave<std::uint32_t> order;
    };
    using Pairs = void (*)(Keys& keys, std::uint32_t reversed_index, std::size_t count, ChoicePairWave& u);
    void (*units)(Keys& keys, std::uint32_t reversed_index, std::size_t count,
                  const Wave<std::uint32_t>& wanted, Wave<float>& u);
    Pairs pairs, choice_pairs, partner_pairs;
    const char* name;  // "AVX2"
  };

  SamplerWave();
  explicit SamplerWave(const Draws& draws) : draws_(draws) {}

  void set(std::size_t lane, const Sampler& sampler);

  /// Goes to another sample of the same pixels and replicate, after as many draws, with Sequence::sobol.
  void set_sample(std::uint32_t reversed_index) { reversed_index_ = reversed_index; }

  [[nodiscard]] Sampler operator[](std::size_t lane) const;

  /// As LaneList::keep().
  void keep(const LaneList& lanes);

  /// Sampler::next() of the lanes where `wanted` is not 0; the others draw nothing and u means nothing.
  void draw(std::size_t count, const Wave<std::uint32_t>& wanted, Wave<float>& u);
  /// Sampler::next_2d()
  void draw_pairs(std::size_t count, ChoicePairWave& u);
  /// Sampler::next_choice_pair()
  void draw_choice_pairs(std::size_t count, ChoicePairWave& u);
  /// Sampler::next_partner_pair()
  void draw_partner_pairs(std::size_t count, ChoicePairWave& u);

 private:
  Draws::Keys keys_;               // with Sequence::sobol
  std::vector<Sampler> samplers_;  // else; of all lanes, once there is one
  Draws draws_;
  Sequence sequence_ = Sequence::sobol;
  std::uint32_t reversed_index_ = 0;
};

/// Those that this machine can run, the fastest first. All draw the same numbers, bit for bit.
[[nodiscard]] const std::vector<SamplerWave::Draws>& all_sampler_wave_draws();

}  // namespace lemma
