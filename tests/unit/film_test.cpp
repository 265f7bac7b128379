#include "src/render/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "src/core/sampler.h"

namespace lemma {
namespace {

/// A film of one pixel with these samples.
Film film_of(const std::vector<float>& samples, std::uint32_t replicates) {
  Film film(1, 1, replicates);
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    film.run(0, 0, 1, i).add(0, {samples[i], 2 * samples[i], 0});
  return film;
}

/// (m1 - m2)^2 n1 n2 / n^2, of the first `first` samples and the rest.
double variance_of_parts(const std::vector<float>& samples, std::size_t first) {
  double a = 0, b = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) (i < first ? a : b) += double{samples[i]};
  const auto n = static_cast<double>(samples.size()), n1 = static_cast<double>(first), n2 = n - n1;
  return std::pow(a / n1 - b / n2, 2) * n1 * n2 / (n * n);
}

TEST(Film, HalvesOfTheSamplesAreAsEqualAsPowersOfTwoAllow) {
  const std::vector<std::size_t> first_of = {0, 0, 1, 1, 2, 2, 2, 4, 4, 4, 4, 4, 4, 8, 8, 8, 8};
  for (std::size_t n = 2; n < first_of.size(); ++n) {
    std::vector<float> samples;
    for (std::size_t i = 0; i < n; ++i) samples.push_back(static_cast<float>((7 * i + 3) % 11));
    const Rgb variance = film_of(samples, 1).variance().at(0, 0);
    EXPECT_FLOAT_EQ(variance.r, static_cast<float>(variance_of_parts(samples, first_of[n])))
        << n << " samples";
    EXPECT_FLOAT_EQ(variance.g, 4 * variance.r);
    EXPECT_EQ(variance.b, 0);
  }
}

TEST(Film, ReplicatesTakeTurns) {
  const Film film = film_of({1, 5, 3, 9}, 2);  // means 2 and 7
  EXPECT_EQ(film.image().at(0, 0).r, 4.5f);
  EXPECT_EQ(film.variance().at(0, 0).r, 6.25f);
  EXPECT_EQ(film.parts(), 2u);
  EXPECT_EQ(film_of({1, 5, 3, 9}, 8).parts(), 8u);
}

TEST(Film, OneSampleTellsNoVariance) {
  for (const std::uint32_t replicates : {1u, 4u}) {
    EXPECT_EQ(film_of({3}, replicates).variance().at(0, 0), Rgb{});
    EXPECT_EQ(film_of({3}, replicates).image().at(0, 0), (Rgb{3, 6, 0}));
  }
}

TEST(Film, LargestRadianceHasAFiniteVariance) {
  EXPECT_EQ(film_of({0, 1e38f}, 1).variance().at(0, 0).r, std::numeric_limits<float>::max());
}

/// Mean of 20000 estimates of a variance, each of n independent numbers uniform in [0, 1): 1 / 12 / n. An
/// estimate of k parts has about the relative variance 2 / (k - 1), so that 5 standard errors are 5 sqrt(2 /
/// 20000) = 5 %.
TEST(Film, VarianceOfIndependentSamplesIsUnbiased) {
  for (const std::uint32_t replicates : {1u, 2u, 5u}) {
    for (const std::uint32_t n : {2u, 3u, 6u, 7u, 10u, 16u}) {
      double sum = 0;
      constexpr std::uint32_t kFilms = 20000;
      for (std::uint32_t pixel = 0; pixel < kFilms; ++pixel) {
        std::vector<float> samples;
        for (std::uint32_t i = 0; i < n; ++i) samples.push_back(Sampler(5, pixel, i).next());
        sum += double{film_of(samples, replicates).variance().at(0, 0).r};
      }
      EXPECT_NEAR(sum / kFilms * 12 * n, 1, 0.05) << replicates << " replicates, " << n << " samples";
    }
  }
}

}  // namespace
}  // namespace lemma
