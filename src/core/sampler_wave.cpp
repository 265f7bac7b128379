#include "src/core/sampler_wave.h"

#include "src/core/instruction_sets.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/core/sampler_wave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {

namespace {

// Plain loops without branches, that compilers turn into vector code of the instruction set.

using Keys = SamplerWave::Draws::Keys;

void units(Keys& keys, std::uint32_t reversed_index, std::size_t count, const Wave<std::uint32_t>& wanted,
           Wave<float>& u) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const std::uint64_t next = keys.next[i] + kGoldenGamma;
    u[i] = Sampler::unit_of(reversed_index, split_mix(next));
    keys.next[i] = wanted[i] != 0 ? next : keys.next[i];
  }
}

void pairs(Keys& keys, std::uint32_t reversed_index, std::size_t count, ChoicePairWave& u) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const std::uint64_t next = keys.next[i] + kGoldenGamma, last = next + kGoldenGamma;
    const Sampler::PairKeys words = Sampler::pair_keys(split_mix(next), split_mix(last));
    const Vec2 pair = Sampler::pair_of(reversed_index, words);
    u.x[i] = pair.x, u.y[i] = pair.y;
    keys.next[i] = last, keys.order[i] = words.order;
  }
}

void choice_pairs(Keys& keys, std::uint32_t reversed_index, std::size_t count, ChoicePairWave& u) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const std::uint64_t next = keys.next[i] + kGoldenGamma, last = next + kGoldenGamma;
    const std::uint64_t words = split_mix(next);
    const Sampler::ChoicePair pair = Sampler::choice_pair_of(reversed_index, words, split_mix(last));
    u.x[i] = pair.x, u.y[i] = pair.y;
    keys.next[i] = last, keys.order[i] = static_cast<std::uint32_t>(words);
  }
}

void partner_pairs(Keys& keys, std::uint32_t reversed_index, std::size_t count, ChoicePairWave& u) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const std::uint64_t next = keys.next[i] + kGoldenGamma, last = next + kGoldenGamma;
    const std::uint64_t words = split_mix(next);
    const Sampler::ChoicePair pair =
        Sampler::partner_pair_of(reversed_index, keys.order[i], words, split_mix(last));
    u.x[i] = pair.x, u.y[i] = pair.y;
    keys.next[i] = last, keys.order[i] = static_cast<std::uint32_t>(words);
  }
}

}  // namespace

SamplerWave::Draws sampler_wave_draws() {
  return {units, pairs, choice_pairs, partner_pairs, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(sampler_wave_draws);

const std::vector<SamplerWave::Draws>& all_sampler_wave_draws() {
  static const std::vector<SamplerWave::Draws> all =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(sampler_wave_draws)(); });
  return all;
}

SamplerWave::SamplerWave() : SamplerWave(HWY_DYNAMIC_DISPATCH(sampler_wave_draws)()) {}

void SamplerWave::set(std::size_t lane, const Sampler& sampler) {
  sequence_ = sampler.sequence_;
  if (sequence_ == Sequence::independent) {
    samplers_.resize(kWaveSize);
    samplers_[lane] = sampler;
  } else {
    reversed_index_ = sampler.reversed_index_;
    keys_.next[lane] = sampler.keys_, keys_.order[lane] = sampler.order_;
  }
}

Sampler SamplerWave::operator[](std::size_t lane) const {
  if (sequence_ == Sequence::independent) return samplers_[lane];
  Sampler sampler;
  sampler.sequence_ = sequence_, sampler.reversed_index_ = reversed_index_;
  sampler.keys_ = keys_.next[lane], sampler.order_ = keys_.order[lane];
  return sampler;
}

void SamplerWave::keep(const LaneList& lanes) {
  if (sequence_ == Sequence::sobol) return lanes.keep(keys_.next), lanes.keep(keys_.order);
  for (std::size_t k = 0; k < lanes.count(); ++k) samplers_[k] = samplers_[lanes[k]];
}

void SamplerWave::draw(std::size_t count, const Wave<std::uint32_t>& wanted, Wave<float>& u) {
  if (sequence_ == Sequence::sobol) return draws_.units(keys_, reversed_index_, count, wanted, u);
  for (std::size_t i = 0; i < count; ++i) {
    if (wanted[i] != 0) u[i] = samplers_[i].next();
  }
}

void SamplerWave::draw_pairs(std::size_t count, ChoicePairWave& u) {
  if (sequence_ == Sequence::sobol) return draws_.pairs(keys_, reversed_index_, count, u);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 pair = samplers_[i].next_2d();
    u.x[i] = pair.x, u.y[i] = pair.y;
  }
}

void SamplerWave::draw_choice_pairs(std::size_t count, ChoicePairWave& u) {
  if (sequence_ == Sequence::sobol) return draws_.choice_pairs(keys_, reversed_index_, count, u);
  for (std::size_t i = 0; i < count; ++i) {
    const Sampler::ChoicePair pair = samplers_[i].next_choice_pair();
    u.x[i] = pair.x, u.y[i] = pair.y;
  }
}

void SamplerWave::draw_partner_pairs(std::size_t count, ChoicePairWave& u) {
  if (sequence_ == Sequence::independent) return draw_choice_pairs(count, u);
  draws_.partner_pairs(keys_, reversed_index_, count, u);
}

}  // namespace lemma
#endif
