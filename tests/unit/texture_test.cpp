#include "src/shading/texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

/// Portable pixmaps are the one format that can be written by hand.
class TextureTest : public testing::Test {
 protected:
  /// 2 x 2 pixels: red, green; below them blue, white.
  Texture colours() const {
    return Texture(folder_.write("a.ppm", "P3\n2 2\n255\n255 0 0  0 255 0\n0 0 255  255 255 255\n"));
  }

  test::SceneFolder folder_;
};

void expect_near(const Rgb& found, const Rgb& wanted) {
  // Half floats: 11 bits, rounded once; the interpolation adds a few roundings of float.
  constexpr float kHalfRounding = 0x1p-11f;
  EXPECT_NEAR(found.r, wanted.r, kHalfRounding);
  EXPECT_NEAR(found.g, wanted.g, kHalfRounding);
  EXPECT_NEAR(found.b, wanted.b, kHalfRounding);
}

TEST_F(TextureTest, OriginIsTheLowerLeftCorner) {
  const Texture texture = colours();
  EXPECT_EQ(texture.width(), 2);
  EXPECT_EQ(texture.height(), 2);
  expect_near(texture.at({0.25f, 0.25f}), {0, 0, 1});
  expect_near(texture.at({0.75f, 0.25f}), {1, 1, 1});
  expect_near(texture.at({0.25f, 0.75f}), {1, 0, 0});
  expect_near(texture.at({0.75f, 0.75f}), {0, 1, 0});
}

TEST_F(TextureTest, InterpolatesBetweenPixelCentresAndRepeats) {
  const Texture texture = colours();
  expect_near(texture.at({0.5f, 0.75f}), {0.5f, 0.5f, 0});
  expect_near(texture.at({0.5f, 0.5f}), {0.5f, 0.5f, 0.5f});
  expect_near(texture.at({0, 0.75f}), {0.5f, 0.5f, 0});  // across the border
  for (const Vec2& whole : {Vec2(1, 0), Vec2(-3, 2), Vec2(1000, -1000)}) {
    expect_near(texture.at(Vec2(0.25f, 0.75f) + whole), {1, 0, 0});
  }
}

TEST_F(TextureTest, FarAwayCoordinatesAreNoFault) {
  const Texture texture = colours();
  for (const float far : {1e10f, -1e10f, 3e38f, -3e38f, 1e-40f, -1e-40f}) {
    const Rgb c = texture.at({far, far});
    EXPECT_TRUE(c.r >= 0 && c.r <= 1) << far;
  }
}

TEST_F(TextureTest, WholeNumbersAreSrgb) {
  // IEC 61966-2-1: 188 / 255 -> ((0.7373 + 0.055) / 1.055)^2.4 = 0.5029; 10 / 255 / 12.92 = 0.003035.
  const Texture texture(folder_.write("a.ppm", "P3\n1 1\n255\n188 10 0\n"));
  expect_near(texture.at({0.3f, 0.6f}), {0.5029f, 0.003035f, 0});
}

TEST_F(TextureTest, FloatingPointIsLinearAndCleaned) {
  // A portable float map, from the bottom row up: 0.25, NaN, -1.
  std::string map = "PF\n1 1\n-1.0\n";
  for (const float value : {0.25f, std::nanf(""), -1.0f})
    map.append(reinterpret_cast<const char*>(&value), 4);
  expect_near(Texture(folder_.write("a.pfm", map)).at({0, 0}), {0.25f, 0, 0});
}

TEST_F(TextureTest, OneChannelIsAGrey) {
  expect_near(Texture(folder_.write("a.pgm", "P2\n1 1\n255\n188\n")).at({0, 0}), {0.5029f, 0.5029f, 0.5029f});
}

TEST_F(TextureTest, WhatIsNoImage) {
  EXPECT_THROW(Texture(folder_.path() / "none.png"), TextureError);
  EXPECT_THROW(Texture(folder_.write("a.png", "no image")), TextureError);
  EXPECT_THROW(Texture(folder_.write("a.ppm", "P3\n2 2\n255\n255 0")), TextureError) << "truncated";
}

TEST_F(TextureTest, ImagesThatTheMachineCannotHoldAreRefusedUnread) {
  try {
    const Texture texture(folder_.write("a.ppm", "P6\n2000000000 2000000000\n255\nabc"));
    FAIL() << "read";
  } catch (const TextureError& error) {
    EXPECT_LT(std::string(error.what()).size(), 300u);
  }
}

}  // namespace
}  // namespace lemma
