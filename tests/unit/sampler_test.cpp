#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

TEST(Sobol, PascalDigitsAreBinomialCoefficientsModuloTwo) {
  for (std::uint32_t j = 0; j < 32; ++j) {
    for (std::uint32_t i = 0; i < 32; ++i) {
      const bool odd = (i & j) == i;  // Lucas
      EXPECT_EQ((pascal_digits(1u << j) >> i) & 1, odd ? 1u : 0u) << i << " " << j;
    }
  }
  EXPECT_EQ(reverse_bits(0x80000001u), 0x80000001u);
  EXPECT_EQ(reverse_bits(0x12345678u), 0x1E6A2C48u);
}

/// The definition of a (0, m, 2)-net: each of the 2^m rectangles of any shape 2^-a x 2^-(m - a) holds exactly
/// one of any aligned run of 2^m points.
TEST(Sobol, EveryAlignedRunIsANet) {
  for (std::uint32_t pixel = 0; pixel < 5; ++pixel) {
    for (std::uint32_t m = 0; m <= 8; ++m) {
      const std::uint32_t count = 1u << m, first = 3 * count;
      for (std::uint32_t a = 0; a <= m; ++a) {
        std::set<std::pair<int, int>> cells;
        for (std::uint32_t i = first; i < first + count; ++i) {
          Sampler random(7, pixel, i, Sequence::sobol);
          const Vec2 u = random.next_2d();
          cells.emplace(static_cast<int>(std::ldexp(u.x, static_cast<int>(a))),
                        static_cast<int>(std::ldexp(u.y, static_cast<int>(m - a))));
        }
        ASSERT_EQ(cells.size(), count) << "pixel " << pixel << " m " << m << " a " << a;
      }
    }
  }
}

/// Each point by itself is uniform over its scramblings, and so are pairs of different draws: chi-square over
/// 16 x 16 cells. False alarms: one in 10^4 for the six tests together.
TEST(Sobol, IsUniformOverScramblingsAndDrawsAreIndependent) {
  constexpr int draws = 1 << 18, cells = 16;
  for (const std::uint32_t sample : {0u, 1u, 1000003u}) {
    std::vector<int> of_pair(cells * cells), of_two_draws(cells * cells);
    for (std::uint32_t pixel = 0; pixel < draws; ++pixel) {
      Sampler random(8, pixel, sample, Sequence::sobol);
      const Vec2 u = random.next_2d();
      const float v = random.next();
      const auto cell = [](float x, float y) {
        return static_cast<std::size_t>(x * cells) * cells + static_cast<std::size_t>(y * cells);
      };
      ++of_pair[cell(u.x, u.y)];
      ++of_two_draws[cell(u.x, v)];
    }
    for (const auto& counts : {of_pair, of_two_draws}) {
      constexpr double expected = static_cast<double>(draws) / (cells * cells);
      double statistic = 0;
      for (const int c : counts) statistic += (c - expected) * (c - expected) / expected;
      EXPECT_GT(test::chi_square_tail(statistic, cells * cells - 1), 1e-4 / 6) << sample;
    }
  }
}

/// The error of a smooth integral falls as N^-1.5 in place of N^-0.5: at 256 samples its variance is at most
/// a fiftieth of that of independent numbers (theory: 256^-2 times a constant of the function, here near
/// 1000).
TEST(Sobol, IntegratesSmoothFunctionsBetter) {
  const auto variance = [](Sequence sequence) {
    std::vector<double> means;
    for (std::uint32_t pixel = 0; pixel < 200; ++pixel) {
      double sum = 0;
      for (std::uint32_t i = 0; i < 256; ++i) {
        Sampler random(9, pixel, i, sequence);
        const Vec2 u = random.next_2d();
        sum += std::exp(-u.x * u.y) * std::cos(u.x + 2 * u.y);
      }
      means.push_back(sum / 256);
    }
    return std::pow(test::estimate(means).standard_error, 2);
  };
  EXPECT_LT(variance(Sequence::sobol), variance(Sequence::independent) / 50);
}

/// A pair and its partner, a point of four dimensions.
std::array<float, 4> with_partner(Sampler& random) {
  const Vec2 u = random.next_2d();
  const auto [x, y] = random.next_partner_pair();
  return {u.x, u.y, static_cast<float>(x), y};
}

/// The definition of a (0, m, 4)-net of base 4: each of the 4^m boxes of any shape 4^-a x 4^-b x 4^-c x 4^-d,
/// a + b + c + d = m, holds exactly one of any aligned run of 4^m points.
TEST(Sobol, PairsWithTheirPartnersAreNetsOfBaseFour) {
  const auto cell = [](float u, int digits) { return static_cast<int>(std::ldexp(u, 2 * digits)); };
  for (std::uint32_t pixel = 0; pixel < 3; ++pixel) {
    for (int m = 1; m <= 4; ++m) {
      const std::uint32_t count = 1u << (2 * m), first = 5 * count;
      for (int a = 0; a <= m; ++a) {
        for (int b = 0; a + b <= m; ++b) {
          for (int c = 0; a + b + c <= m; ++c) {
            std::set<std::array<int, 4>> boxes;
            for (std::uint32_t i = first; i < first + count; ++i) {
              Sampler random(7, pixel, i, Sequence::sobol);
              const auto u = with_partner(random);
              boxes.insert({cell(u[0], a), cell(u[1], b), cell(u[2], c), cell(u[3], m - a - b - c)});
            }
            ASSERT_EQ(boxes.size(), count) << "pixel " << pixel << " m " << m << ": " << a << b << c;
          }
        }
      }
    }
  }
}

/// Partners by themselves are as well spread as other pairs.
TEST(Sobol, PartnersAreNetsOfBaseTwo) {
  for (int m = 0; m <= 8; ++m) {
    const std::uint32_t count = 1u << m, first = 3 * count;
    for (int a = 0; a <= m; ++a) {
      std::set<std::pair<int, int>> cells;
      for (std::uint32_t i = first; i < first + count; ++i) {
        Sampler random(7, 1, i, Sequence::sobol);
        const auto u = with_partner(random);
        cells.emplace(static_cast<int>(std::ldexp(u[2], a)), static_cast<int>(std::ldexp(u[3], m - a)));
      }
      ASSERT_EQ(cells.size(), count) << "m " << m << " a " << a;
    }
  }
}

/// Over its scramblings a point is uniform in four dimensions: chi-square over 4^4 boxes. False alarms: one
/// in 10^4 for the three tests together.
TEST(Sobol, PairsWithTheirPartnersAreUniformOverScramblings) {
  constexpr int draws = 1 << 18, boxes = 256;
  for (const std::uint32_t sample : {0u, 1u, 1000003u}) {
    std::vector<int> counts(boxes);
    for (std::uint32_t pixel = 0; pixel < draws; ++pixel) {
      Sampler random(8, pixel, sample, Sequence::sobol);
      std::size_t box = 0;
      for (const float u : with_partner(random)) box = 4 * box + static_cast<std::size_t>(4 * u);
      ++counts[box];
    }
    constexpr double expected = static_cast<double>(draws) / boxes;
    double statistic = 0;
    for (const int c : counts) statistic += (c - expected) * (c - expected) / expected;
    EXPECT_GT(test::chi_square_tail(statistic, boxes - 1), 1e-4 / 3) << sample;
  }
}

/// A second partner has an order of its own: 16 samples put it and the first into 16 (1 - (15/16)^16) = 10.3
/// of the 4 x 4 cells of their x in the mean, and into 4 where both are of the same pair.
TEST(Sobol, SecondPartnersAreIndependent) {
  std::size_t cells_hit = 0;
  constexpr std::uint32_t pixels = 100;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    std::set<std::pair<int, int>> cells;
    for (std::uint32_t i = 0; i < 16; ++i) {
      Sampler random(11, pixel, i, Sequence::sobol);
      const float first = with_partner(random)[2];
      const auto second = static_cast<float>(random.next_partner_pair().x);
      cells.emplace(static_cast<int>(4 * first), static_cast<int>(4 * second));
    }
    cells_hit += cells.size();
  }
  EXPECT_GT(cells_hit, 8 * pixels);
}

/// What a pair and its partner do to each other is integrated better than by two pairs that know nothing of
/// each other: variance at 256 samples.
TEST(Sobol, PartnersIntegrateInteractionsBetter) {
  const auto variance = [](bool partners) {
    std::vector<double> means;
    for (std::uint32_t pixel = 0; pixel < 200; ++pixel) {
      double sum = 0;
      for (std::uint32_t i = 0; i < 256; ++i) {
        Sampler random(9, pixel, i, Sequence::sobol);
        const Vec2 u = random.next_2d();
        const auto [x, y] = partners ? random.next_partner_pair() : random.next_choice_pair();
        sum += std::exp(-u.x * x) * std::cos(u.y + 2 * y);
      }
      means.push_back(sum / 256);
    }
    return std::pow(test::estimate(means).standard_error, 2);
  };
  EXPECT_LT(variance(true), variance(false) / 10);
}

TEST(Sobol, NumbersDependOnSeedPixelSampleAndDraw) {
  std::set<std::uint32_t> seen;
  for (const std::uint64_t seed : {0ull, 1ull, 1ull << 32}) {
    for (const std::uint32_t pixel : {0u, 1u}) {
      for (const std::uint32_t sample : {0u, 1u}) {
        Sampler random(seed, pixel, sample, Sequence::sobol), again(seed, pixel, sample, Sequence::sobol);
        for (int draw = 0; draw < 3; ++draw) {
          const std::uint32_t bits = random.next_bits();
          EXPECT_EQ(bits, again.next_bits());
          EXPECT_TRUE(seen.insert(bits).second);
        }
      }
    }
  }
}

/// The pair for a choice is that of next_2d, with more bits behind those of x; they differ from pixel to
/// pixel.
TEST(Sampler, ChoicePairsArePairsWithMoreBits) {
  std::set<double> rests;
  for (std::uint32_t pixel = 0; pixel < 100; ++pixel) {
    Sampler coarse(10, pixel, 5, Sequence::sobol), fine(10, pixel, 5, Sequence::sobol);
    for (int draw = 0; draw < 3; ++draw) {
      const Vec2 u = coarse.next_2d();
      const auto [x, y] = fine.next_choice_pair();
      ASSERT_EQ(u.x, std::floor(std::ldexp(x, 24)) * 0x1p-24);
      ASSERT_EQ(u.y, y);
      rests.insert(std::ldexp(x, 32) - std::floor(std::ldexp(x, 32)));
    }
  }
  EXPECT_GT(rests.size(), 290u);  // of 2^21
}

TEST(Sampler, DecisionsLeaveAUniformNumber) {
  constexpr double last = 1 - 0x1p-53;
  for (const double p : {0.0, 1e-6, 0.25, 1 - 1e-6, 1.0}) {
    for (const double rest : {0.0, 0.25, 0.5}) {
      const auto below = decide(rest * p, p);
      EXPECT_EQ(below.first, p > 0);
      if (p > 0) {
        EXPECT_FLOAT_EQ(below.rest, static_cast<float>(rest));
      }
      if (p == 1) continue;
      const auto above = decide(p + rest * (1 - p), p);
      EXPECT_FALSE(above.first);
      EXPECT_NEAR(above.rest, rest, 1e-9);
    }
    EXPECT_EQ(decide(last, p).first, p == 1);
    EXPECT_EQ(decide(last, p).rest, 1 - 0x1p-24f);
  }
}

/// Roundings of the angle, of 2 pi and of their product, move it by 3 u pi / 4; the series and its last steps
/// round some values below 1: 3 u. Quarter turns are exact.
template <class T>
void expect_sin_cos_turn() {
  constexpr T tolerance = 3 * std::numeric_limits<T>::epsilon();  // 6 u
  for (int i = -1000; i <= 1000; ++i) {
    const T u = static_cast<T>(i) / 1000;
    const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(u);
    const auto [sine, cosine] = sin_cos_turn(u);
    EXPECT_NEAR(static_cast<double>(sine - std::sin(angle)), 0, tolerance) << u;
    EXPECT_NEAR(static_cast<double>(cosine - std::cos(angle)), 0, tolerance) << u;
  }
  for (const int quarter : {-4, -3, -2, -1, 0, 1, 2, 3, 4}) {
    const auto [sine, cosine] = sin_cos_turn(static_cast<T>(quarter) / 4);
    EXPECT_EQ(std::abs(sine), quarter % 2 == 0 ? 0 : 1);
    EXPECT_EQ(std::abs(cosine), quarter % 2 == 0 ? 1 : 0);
  }
}

TEST(Warp, SineAndCosineOfTurns) {
  expect_sin_cos_turn<float>();
  expect_sin_cos_turn<double>();
}

}  // namespace
}  // namespace lemma
