#include "src/measure/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace lemma {
namespace {

constexpr int kWidth = 64, kHeight = 48;

/// Waves of three colours, with an edge and a point: values in [0, 1]. Made of numbers that other languages
/// make in the same way.
Image waves(double phase) {
  Image image{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double edge = x > 40 && y > 20 ? 0.4 : 0, point = x == 10 && y == 10 ? 0.5 : 0;
      const auto wave = [&](double frequency, double base) {
        return static_cast<float>(base + 0.25 * std::sin(frequency * x + phase) * std::cos(0.2 * y) + edge +
                                  point);
      };
      image.pixels.push_back({wave(0.1, 0.3), wave(0.3, 0.27), wave(0.7, 0.25)});
    }
  }
  return image;
}

/// The same as radiance: squares, up to a thousand in one corner, black in another.
Image radiances(double phase) {
  Image image = waves(phase);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      Rgb& c = image.at(x, y);
      c *= c;
      if (x < 8 && y < 8) c *= 1000.0f;
      if (x > 55 && y < 8) c = {};
    }
  }
  return image;
}

double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

float at(const std::vector<float>& values, int x, int y) {
  return values[static_cast<std::size_t>(y * kWidth + x)];
}

/// Expected values: NVIDIA's flip-evaluator 1.7, the authors' own program, on these images. It works in
/// float.
constexpr double kTolerance = 2e-5;

TEST(Flip, PicturesAsByItsAuthors) {
  const auto flip = ldr_flip(waves(0.3), waves(0));
  EXPECT_NEAR(mean(flip), 0.1767069, kTolerance);
  EXPECT_NEAR(at(flip, 0, 0), 0.2982661, kTolerance);
  EXPECT_NEAR(at(flip, 10, 10), 0.1823664, kTolerance);
  EXPECT_NEAR(at(flip, 41, 30), 0.4041555, kTolerance);
  EXPECT_NEAR(at(flip, 63, 47), 0.3256389, kTolerance);
}

TEST(Flip, RadianceAsByItsAuthors) {
  const auto flip = hdr_flip(radiances(0.3), radiances(0));
  EXPECT_NEAR(mean(flip), 0.3106918, kTolerance);
  EXPECT_NEAR(at(flip, 0, 0), 0.3506586, kTolerance);
  EXPECT_NEAR(at(flip, 10, 10), 0.3476746, kTolerance);
  EXPECT_NEAR(at(flip, 41, 30), 0.3721759, kTolerance);
  EXPECT_NEAR(at(flip, 63, 47), 0.2827513, kTolerance);
}

TEST(Flip, EndsOfItsRange) {
  for (const float value : ldr_flip(waves(1), waves(1))) EXPECT_EQ(value, 0);
  for (const float value : hdr_flip(radiances(1), radiances(1))) EXPECT_EQ(value, 0);
  const Image green{8, 8, std::vector<Rgb>(64, Rgb{0, 1, 0})}, blue{8, 8, std::vector<Rgb>(64, Rgb{0, 0, 1})};
  for (const float value : ldr_flip(green, blue)) EXPECT_NEAR(value, 1, 1e-5);
}

TEST(Flip, BlackReference) {
  const Image black{8, 8, std::vector<Rgb>(64)};
  Image spot = black;
  spot.at(3, 3) = {5, 5, 5};
  for (const float value : hdr_flip(black, black)) EXPECT_EQ(value, 0);
  EXPECT_GT(mean(hdr_flip(spot, black)), 0);
  EXPECT_GT(mean(hdr_flip(black, spot)), 0);  // the median of the reference is black
}

}  // namespace
}  // namespace lemma
