#include "src/measure/error_figures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/measure/difference_image.h"

namespace lemma {
namespace {

/// Values that are exact in binary, so that the figures can be worked out by hand.
const Image kReference{2, 1, {{0, 1, 2}, {0.5f, 0.5f, 0.5f}}};
const Image kImage{2, 1, {{1, 1, 0}, {0.5f, 0.25f, 0.5f}}};

TEST(ErrorFigures, AreTheirDefinitions) {
  const ErrorFigures e = error_figures(kImage, kReference);
  EXPECT_DOUBLE_EQ(e.mse, (1 + 0 + 4 + 0.0625) / 6);
  EXPECT_DOUBLE_EQ(e.relmse, (1 / 0.01 + 4 / 4.01 + 0.0625 / 0.26) / 6);
  EXPECT_DOUBLE_EQ(e.smape, (2 + 2 + 2 * 0.25 / 0.75) / 6);
  EXPECT_EQ(e.mean_difference, (std::array<double, 3>{0.5, -0.125, -1}));
}

TEST(ErrorFigures, AreZeroForEqualImagesEvenWhereBothAreBlack) {
  const ErrorFigures e = error_figures(kReference, kReference);
  EXPECT_EQ(e.mse, 0);
  EXPECT_EQ(e.relmse, 0);
  EXPECT_EQ(e.smape, 0);
}

TEST(ErrorFigures, TrimmingLeavesOutOnePixelOfAThousand) {
  Image image{100, 20, std::vector<Rgb>(2000, Rgb{1, 1, 1})};
  const Image reference = image;
  image.at(3, 4) = {1000, 1000, 1000};
  image.at(7, 9) = {500, 500, 500};
  image.at(50, 10) = {2, 2, 2};
  EXPECT_DOUBLE_EQ(error_figures(image, reference).trimmed_relmse, 1 / 1.01 / 1998);
}

TEST(ErrorFigures, NoiseOfTheReferenceIsItsMeanVariance) {
  const Image variance{2, 1, {{1, 2, 3}, {0, 0, 0.26f}}};
  const ReferenceNoise noise = reference_noise(kReference, variance);
  EXPECT_DOUBLE_EQ(noise.mse, (6 + double{0.26f}) / 6);
  EXPECT_DOUBLE_EQ(noise.relmse, (1 / 0.01 + 2 / 1.01 + 3 / 4.01 + double{0.26f} / 0.26) / 6);
}

TEST(ErrorFigures, LargestDifferencesComeFirst) {
  const Image black{3, 2, std::vector<Rgb>(6)};
  const Image image{3, 2, {{0, 0, 0}, {3, 4, 0}, {0, 0, -5}, {6, 0, 0}, {}, {}}};
  const auto largest = largest_differences(image, black, 3);
  ASSERT_EQ(largest.size(), 3u);
  const auto expect = [](const PixelDifference& p, int x, int y, double distance) {
    EXPECT_EQ(std::tuple(p.x, p.y, p.distance), std::tuple(x, y, distance));
  };
  expect(largest[0], 0, 1, 6);
  expect(largest[1], 1, 0, 5);
  expect(largest[2], 2, 0, 5);
  EXPECT_EQ(largest_differences(image, black, 100).size(), 3u) << "those that differ";
}

TEST(DifferenceImage, TellsTheSignByColor) {
  const Image reference{3, 1, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  const Image image{3, 1, {{0, 0, 0}, {1, 1, 1}, {9, 9, 9}}};
  const Image colors = false_color(image, reference, 1);
  EXPECT_GT(colors.at(0, 0).b, colors.at(0, 0).r);
  EXPECT_EQ(colors.at(1, 0), (Rgb{1, 1, 1}));
  EXPECT_GT(colors.at(2, 0).r, colors.at(2, 0).b);
  EXPECT_EQ(signed_difference(image, reference).at(0, 0), (Rgb{-1, -1, -1}));
  EXPECT_EQ(difference_scale(reference, reference), 1);
}

}  // namespace
}  // namespace lemma
