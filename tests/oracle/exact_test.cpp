#include "src/oracle/exact.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/meshes.h"

namespace lemma {
namespace {

std::optional<ExactHit> hit(const Ray& ray, const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return exact_hit(ray, triangles, all);
}

TEST(ExactHit, EdgesAndVerticesBelongToTheTriangle) {
  const std::vector<Triangle> one{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
  for (const Vec3& target :
       {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1), Vec3(0.5f, 0, 1), Vec3(0.5f, 0.5f, 1)}) {
    const auto found = hit({{0.25f, 0.25f, 0}, target - Vec3(0.25f, 0.25f, 0)}, one);
    ASSERT_TRUE(found) << target;
    EXPECT_EQ(found->t, 1) << target;
  }
}

/// Off by the smallest step that floats near 1 can make, which no float32 test would see in the product.
TEST(ExactHit, OneUnitInTheLastPlaceDecides) {
  const std::vector<Triangle> one{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
  const float beyond = std::nextafter(1.0f, 2.0f), within = std::nextafter(1.0f, 0.0f);
  EXPECT_TRUE(hit({{0, 0, 0}, {1, 0, 1}}, one));
  EXPECT_TRUE(hit({{0, 0, 0}, {within, 0, 1}}, one));
  EXPECT_FALSE(hit({{0, 0, 0}, {beyond, 0, 1}}, one));
  EXPECT_FALSE(hit({{0, 0, 0}, {0.5f, -0x1p-140f, 1}}, one)) << "beside by a subnormal number";
}

TEST(ExactHit, RangeIsOpenAtBothEnds) {
  const std::vector<Triangle> one{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
  const Vec3 from(0.25f, 0.25f, 0), up(0, 0, 1);
  EXPECT_FALSE(hit({from, up, 1, 2}, one));
  EXPECT_FALSE(hit({from, up, 0, 1}, one));
  EXPECT_TRUE(hit({from, up, std::nextafter(1.0f, 0.0f), std::nextafter(1.0f, 2.0f)}, one));
  EXPECT_FALSE(hit({{0.25f, 0.25f, 1}, up}, one)) << "starts on the triangle";
}

TEST(ExactHit, TiesGoToTheLowestIndexAndParallelPlanesAreNotMet) {
  const Triangle a{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, copy{{0, 1, 1}, {0, 0, 1}, {1, 0, 1}};
  const Ray ray{{0.1f, 0.2f, -3}, {0, 0, 1}};
  EXPECT_EQ(hit(ray, {a, copy})->triangle, 0u);
  EXPECT_FALSE(hit({{-1, 0.2f, 1}, {1, 0, 0}}, {a}));
}

/// 0.1f and 0.3f are no multiples of each other: t = 3.0000002... is told apart from the float next to it.
TEST(ExactHit, DistancesThatDoubleCannotTellApartAreCompared) {
  const float depth = 0.3f, step = 0.1f;
  const std::vector<Triangle> one{{{-1, -1, depth}, {1, -1, depth}, {0, 1, depth}}};
  const auto t = static_cast<float>(static_cast<double>(depth) / step);
  const bool above = static_cast<double>(depth) / step > t;
  EXPECT_EQ(hit({{0, 0, 0}, {0, 0, step}, 0, t}, one).has_value(), !above);
  EXPECT_EQ(hit({{0, 0, 0}, {0, 0, step}, t, 4}, one).has_value(), above);
}

}  // namespace
}  // namespace lemma
