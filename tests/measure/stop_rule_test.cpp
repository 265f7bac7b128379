#include "src/measure/stop_rule.h"

#include <gtest/gtest.h>

#include <vector>

namespace lemma {
namespace {

/// The samples after each pass, of a rendering with this speed and this relMSE at one sample, which falls as
/// one over their number.
std::vector<std::uint32_t> passes(const StopRule& rule, double seconds_a_sample, double relmse) {
  std::vector<std::uint32_t> passes;
  PassState state;
  for (std::uint32_t next = next_spp(rule, state); next > state.spp; next = next_spp(rule, state)) {
    passes.push_back(next);
    state = {next, next * seconds_a_sample, relmse / next};
  }
  return passes;
}

using Passes = std::vector<std::uint32_t>;

TEST(StopRule, SamplesAloneTakeOnePass) {
  EXPECT_EQ(passes({.spp = 100}, 1, 1), (Passes{100}));
}

TEST(StopRule, LooksAreAtPowersOfTwo) {
  EXPECT_EQ(passes({.spp = 20, .looks = true}, 1, 1), (Passes{1, 2, 4, 8, 16, 20}));
}

TEST(StopRule, TimeIsUsedButNotExceeded) {
  EXPECT_EQ(passes({.spp = 1000, .seconds = 10.5}, 1, 1), (Passes{1, 2, 4, 8, 10}));
  EXPECT_EQ(passes({.spp = 6, .seconds = 10.5}, 1, 1), (Passes{1, 2, 4, 6}));
  EXPECT_EQ(passes({.spp = 1000, .seconds = 0.1}, 1, 1), (Passes{1})) << "one sample there must be";
  EXPECT_EQ(passes({.spp = 1000, .seconds = 32.9}, 1, 1), (Passes{1, 2, 4, 8, 16, 32}))
      << "one more is not worth it";
}

TEST(StopRule, ErrorIsReachedInQuarters) {
  EXPECT_EQ(passes({.spp = 1000, .relmse = 0.1}, 1, 1), (Passes{16})) << "not looked at before";
  EXPECT_EQ(passes({.spp = 1000, .relmse = 0.01}, 1, 1), (Passes{16, 32, 64, 112}));
  EXPECT_EQ(passes({.spp = 50, .relmse = 0.01}, 1, 1), (Passes{16, 32, 50}));
}

TEST(StopRule, WhateverComesFirst) {
  EXPECT_EQ(passes({.spp = 1000, .seconds = 24.0, .relmse = 0.01}, 1, 1), (Passes{1, 2, 4, 8, 16, 24}));
  EXPECT_EQ(passes({.spp = 1000, .seconds = 1e9, .relmse = 0.0625}, 1, 1), (Passes{1, 2, 4, 8, 16}));
}

}  // namespace
}  // namespace lemma
