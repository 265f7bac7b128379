#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "src/core/alias_table.h"
#include "src/core/error_bound.h"
#include "src/core/frame.h"
#include "src/core/parallel.h"
#include "src/core/pdf.h"
#include "src/core/rgb.h"
#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

// Known answers of the generator's authors: Random123, kat_vectors, philox4x32 10.
TEST(Philox, KnownAnswers) {
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t f = 0xffffffff;
  EXPECT_EQ(philox4x32({f, f, f, f}, {f, f}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// The first outputs of Vigna's splitmix64.c for the seed 1234567.
TEST(SplitMix, KnownAnswers) {
  std::uint64_t state = 1234567;
  for (const std::uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                       4593380528125082431u, 16408922859458223821u}) {
    EXPECT_EQ(split_mix(state += kGoldenGamma), expected);
  }
}

TEST(Sampler, DependsOnSeedPixelAndSampleAlone) {
  const auto first = [](std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample) {
    return Sampler(seed, pixel, sample).next_bits();
  };
  EXPECT_EQ(first(1, 2, 3), first(1, 2, 3));
  const std::set<std::uint32_t> all{first(1, 2, 3), first(2, 2, 3), first(1, 3, 3), first(1, 2, 4),
                                    first(1ull << 32, 2, 3)};
  EXPECT_EQ(all.size(), 5u);
}

TEST(Sampler, StaysBelowOne) {
  // The largest 32-bit word gives 1 - 2^-24.
  EXPECT_LT(static_cast<float>(0xFFFFFFFFu >> 8) * 0x1p-24f, 1.0f);
  Sampler random(7, 0, 0);
  for (int i = 0; i < 10000; ++i) {
    const float u = random.next();
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
  }
}

TEST(AliasTable, ReproducesItsWeights) {
  const std::vector<double> weights{0.5, 0, 3, 1e-3, 2, 0, 7, 0.1};
  double sum = 0;
  for (const double w : weights) sum += w;
  const AliasTable table(weights);
  // All 2^32 integers in steps of 2^12: 2^20 evenly spaced draws, so each count errs by at most one per piece
  // of an index's range, of which a table of 8 has at most 9.
  std::vector<int> counts(weights.size());
  constexpr int draws = 1 << 20;
  for (int i = 0; i < draws; ++i) ++counts[table.sample(static_cast<std::uint32_t>(i) << 12)];
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    EXPECT_NEAR(counts[i], weights[i] / sum * draws, 9) << i;
    EXPECT_FLOAT_EQ(table.pmf(i), static_cast<float>(weights[i] / sum)) << i;
    if (weights[i] == 0) {
      EXPECT_EQ(counts[i], 0) << i;
    }
  }
}

TEST(Frame, IsOrthonormalForAllNormals) {
  Sampler random(1, 0, 0);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = i < 2 ? Vec3(0, 0, i == 0 ? 1.0f : -1.0f) : normalize(test::random_direction(random));
    const Frame f = frame_around(n);
    // Each entry is a sum of a few products of numbers up to 2: 8 roundings of size 2^-24.
    constexpr float bound = 8 * 0x1p-23f;
    ASSERT_NEAR(dot(f.s, f.t), 0, bound);
    ASSERT_NEAR(dot(f.s, f.n), 0, bound);
    ASSERT_NEAR(dot(f.t, f.n), 0, bound);
    ASSERT_NEAR(length(f.s), 1, bound);
    ASSERT_NEAR(length(f.t), 1, bound);
    ASSERT_GT(dot(cross(f.s, f.t), f.n), 0);
  }
}

TEST(CosineHemisphere, ReachesNoDirectionBelowAndHasUnitLength) {
  constexpr float last = 1 - 0x1p-24f;
  for (const Vec2& u : {Vec2(0, 0), Vec2(last, 0), Vec2(0, last), Vec2(last, last), Vec2(0.5f, 0.5f)}) {
    const Vec3 w = cosine_hemisphere(u);
    EXPECT_GT(w.z, 0);
    EXPECT_NEAR(length(w), 1, 4 * 0x1p-23);
  }
}

TEST(Heuristics, WeightsOfBothTechniquesSumToOne) {
  for (const float a : {1e-30f, 1e-3f, 1.0f, 1e30f}) {
    for (const float b : {1e-30f, 1e-3f, 1.0f, 1e30f}) {
      EXPECT_NEAR(balance_heuristic({a}, {b}) + balance_heuristic({b}, {a}), 1, 4 * 0x1p-24);
      EXPECT_NEAR(power_heuristic({a}, {b}) + power_heuristic({b}, {a}), 1, 4 * 0x1p-24);
    }
  }
  EXPECT_EQ(balance_heuristic({0}, {0}), 0);
  EXPECT_EQ(balance_heuristic({INFINITY}, {INFINITY}), 1);
  EXPECT_EQ(power_heuristic({0}, {0}), 0);
  EXPECT_EQ(power_heuristic({INFINITY}, {INFINITY}), 1);
  EXPECT_FLOAT_EQ(power_heuristic({3e30f}, {1e30f}), 0.9f);
  EXPECT_FLOAT_EQ(power_heuristic({3e-30f}, {1e-30f}), 0.9f);
}

TEST(OffsetOrigin, NextFloatIsTheLibrarys) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Sampler random(5, 0, 0);
  const auto expect_same = [](float x) {
    for (const double direction : {1e-300, 1.0, -1e-300, -1.0}) {
      const float expected = std::nextafter(x, direction > 0 ? infinity : -infinity);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(next_float_towards(x, direction)),
                std::bit_cast<std::uint32_t>(expected))
          << x << " " << direction;
    }
    EXPECT_EQ(next_float_towards(x, 0), x);
  };
  for (const float x :
       {0.0f, -0.0f, 0x1p-149f, -0x1p-149f, 0x1p-126f, 1.0f, -1.0f, 0x1.fffffep127f, -0x1.fffffep127f}) {
    expect_same(x);
  }
  for (int i = 0; i < 10000; ++i) {
    const auto x = std::bit_cast<float>(random.next_bits());
    if (std::isfinite(x)) expect_same(x);
  }
  EXPECT_EQ(next_float_towards(infinity, -1), infinity);
}

TEST(OffsetOrigin, LiesStrictlyOnTheSideOfTheNormal) {
  Sampler random(3, 0, 0);
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    for (const float shift : {0.0f, 1e3f}) {
      for (int i = 0; i < 2000; ++i) {
        const auto corner = [&] { return test::random_point(random) * scale + Vec3(shift * scale); };
        const Vec3 v0 = corner(), v1 = corner();
        const Triangle t{v0, v1, corner()};
        const Vec3d n = normalize(area_vector(t));
        const auto [b1, b2] = uniform_triangle(random.next_2d());
        const Vec3d p = point_at(t, b1, b2);
        const Vec3 origin = offset_origin(p, n, t);
        ASSERT_GT(dot(Vec3d(origin) - Vec3d(t.v0), n), 0);
        // Not farther than the bound and two ulps on each axis say.
        ASSERT_LT(length(Vec3d(origin) - p), kRoundoff * (kPlaneError * 2 * scale + 6 * max_norm(p) * 2));
      }
    }
  }
}

TEST(ParallelFor, VisitsEachIndexOnceAndPassesExceptionsOn) {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(limit.threads(), threads);
    std::vector<int> visits(1000);
    parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(1000, 1));
    EXPECT_THROW(parallel_for(10,
                              [](std::size_t i) {
                                if (i == 5) throw std::runtime_error("five");
                              }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace lemma
