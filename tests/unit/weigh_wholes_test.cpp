#include "src/lights/weigh_wholes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/lights/sphere_cone.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

/// A block of whole lights at some places, in between none.
WholeBlock some_wholes() {
  WholeBlock block;
  Sampler random(51, 0, 0);
  for (std::size_t i = 0; i < WholeBlock::kSize; i += i % 4 == 0 ? 1 : 3) {
    const Vec3d centre(Vec3(random.next(), random.next(), random.next()) * 4 - Vec3(2));
    block.set(i, {centre, 0.05 + 0.5 * random.next(), {}}, 1 + random.next());
  }
  return block;
}

LightQuery random_query(Sampler& random) {
  LightQuery at;
  at.x = Vec3(random.next(), random.next(), random.next()) * 4 - Vec3(2);
  at.n = test::random_direction(random);
  const float peak = random.next() < 0.5f ? 0.0f : 4 * random.next();
  at.reflection = {test::random_direction(random), 0.1f, peak, 0.1f + random.next()};
  return at;
}

/// Every instruction set that this machine has: the same weights, bit for bit.
TEST(WeighWholes, InstructionSetsAgree) {
  const WholeBlock block = some_wholes();
  const auto& all = all_weigh_wholes();
  ASSERT_FALSE(all.empty());
  Sampler random(52, 0, 0);
  for (int k = 0; k < 1000; ++k) {
    const LightQuery at = random_query(random);
    WholeBlock::Values expected;
    all.back().function(block, WholeBlock::kSize, at, expected);
    for (const WeighWholes& set : all) {
      WholeBlock::Values weights;
      set.function(block, WholeBlock::kSize, at, weights);
      ASSERT_EQ(weights, expected) << set.name;
    }
  }
}

/// The same formulas in double, from SphereCone and Reflection. The cosines' slack is 10^-5, the
/// exponential's error 6 10^-5 of it; roundings of the exponent, whose terms are at most 40 here, another
/// 10^-5.
TEST(WeighWholes, AreLuminanceSolidAngleCosineAndReflection) {
  const WholeBlock block = some_wholes();
  Sampler random(53, 0, 0);
  int weighed = 0;
  for (int k = 0; k < 1000; ++k) {
    const LightQuery at = random_query(random);
    WholeBlock::Values weights;
    all_weigh_wholes().front().function(block, WholeBlock::kSize, at, weights);
    for (std::size_t i = 0; i < WholeBlock::kSize; ++i) {
      const Vec3d centre(double{block.x[i]} + block.rest_x[i], double{block.y[i]} + block.rest_y[i],
                         double{block.z[i]} + block.rest_z[i]);
      const SphereCone cone(centre, std::sqrt(block.radius2[i]), at.x);
      if (block.radius2[i] == 0 || !cone.can_be_sampled()) {
        ASSERT_EQ(weights[i], -1) << i;
        continue;
      }
      const double half = std::acos(1 - cone.one_minus_cos());
      const double angle = std::acos(std::clamp(dot(Vec3d(at.n), cone.axis()), -1.0, 1.0));
      const double largest = std::cos(std::max(angle - half, 0.0)), smallest = std::cos(angle + half);
      const double cosine = (std::max(largest, 0.0) + std::max(smallest, 0.0)) / 2;
      const double scale = block.luminance[i] * cone.solid_angle() *
                           at.reflection.mean(Vec3(cone.axis()), static_cast<float>(cone.one_minus_cos()));
      ASSERT_NEAR(weights[i], scale * cosine, scale * (1e-5 + 1e-4 * cosine)) << i;
      ++weighed;
    }
  }
  EXPECT_GT(weighed, 5000);
}

TEST(WeighWholes, ArePositiveAboveTheHorizon) {
  WholeBlock block;
  block.set(0, {{0, 0, 1}, 0.5, {}}, 1);  // half angle 30 degrees
  const auto weight = [&](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    LightQuery at{{0, 0, 0}, Vec3(Vec3d(std::sin(angle), 0, std::cos(angle)))};
    WholeBlock::Values weights;
    all_weigh_wholes().front().function(block, 1, at, weights);
    return weights[0];
  };
  EXPECT_GT(weight(119.9999), 0);
  EXPECT_EQ(weight(120.01), 0);
}

}  // namespace
}  // namespace lemma
