#include "src/core/sampler_wave.h"

#include <gtest/gtest.h>

namespace lemma {
namespace {

constexpr std::size_t kSomeCounts[] = {1, 15, 16, 17, kWaveSize};

/// Partners, and those of partners, of the pairs drawn last.
void expect_partners(SamplerWave& wave, std::vector<Sampler>& single, std::size_t count) {
  ChoicePairWave pairs;
  for (int draw = 0; draw < 2; ++draw) {
    wave.draw_partner_pairs(count, pairs);
    for (std::size_t i = 0; i < count; ++i) {
      const Sampler::ChoicePair pair = single[i].next_partner_pair();
      ASSERT_EQ(pairs.x[i], pair.x);
      ASSERT_EQ(pairs.y[i], pair.y);
    }
  }
}

/// Draws of every kind, some lanes left out or none, against samplers by themselves.
void expect_draws_of_samplers(SamplerWave& wave, Sequence sequence, std::size_t count) {
  std::vector<Sampler> single;
  for (std::uint32_t i = 0; i < count; ++i) {
    single.emplace_back(5, 1000 + 7 * i, 77, sequence, 1);
    wave.set(i, single.back());
  }
  Wave<float> u;
  ChoicePairWave pairs;
  Wave<std::uint32_t> wanted;
  for (int round = 0; round < 3; ++round) {
    wave.draw_pairs(count, pairs);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 pair = single[i].next_2d();
      ASSERT_EQ(pairs.x[i], pair.x);
      ASSERT_EQ(pairs.y[i], pair.y);
      wanted[i] = i % 3 == 0 ? 1 : 0;
    }
    expect_partners(wave, single, count);
    wave.draw(count, wanted, u);
    for (std::size_t i = 0; i < count; i += 3) ASSERT_EQ(u[i], single[i].next());
    wave.draw_choice_pairs(count, pairs);
    for (std::size_t i = 0; i < count; ++i) {
      const Sampler::ChoicePair pair = single[i].next_choice_pair();
      ASSERT_EQ(pairs.x[i], pair.x);
      ASSERT_EQ(pairs.y[i], pair.y);
    }
    // Every second lane goes on.
    LaneList kept;
    for (std::size_t i = 0; i < count; ++i) kept.add_if(i % 2 == 0, i);
    for (std::size_t k = 0; k < kept.count(); ++k) single[k] = single[kept[k]];
    count = kept.count();
    wave.keep(kept);
    if (round == 1) expect_partners(wave, single, count);  // of pairs from before lanes were left out
  }
  Sampler last = wave[count - 1];
  ASSERT_EQ(last.next(), single[count - 1].next());
}

TEST(SamplerWave, DrawsWhatSamplersDraw) {
  ASSERT_FALSE(all_sampler_wave_draws().empty());
  for (const SamplerWave::Draws& draws : all_sampler_wave_draws()) {
    SCOPED_TRACE(draws.name);
    for (const std::size_t count : kSomeCounts) {
      for (const Sequence sequence : {Sequence::sobol, Sequence::independent}) {
        SamplerWave wave(draws);
        expect_draws_of_samplers(wave, sequence, count);
      }
    }
  }
}

}  // namespace
}  // namespace lemma
