#include "src/oracle/oracle.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "tests/support/meshes.h"

namespace lemma {
namespace {

const Triangle kTriangle{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};

Expectation expect(const Ray& ray, const std::vector<Triangle>& triangles) {
  return Oracle(triangles).expect(ray);
}

std::optional<Hit> hit_at(float t, std::uint32_t triangle) {
  return Hit{t, triangle, 0, 0};
}

TEST(Oracle, DecidesWhatIsClear) {
  const Expectation through = expect({{0.2f, 0.2f, 0}, {0, 0, 1}}, {kTriangle});
  EXPECT_FALSE(through.doubt);
  EXPECT_TRUE(through.must_hit);
  EXPECT_EQ(through.judge(hit_at(1, 0)), Verdict::right);
  EXPECT_EQ(through.judge(std::nullopt), Verdict::missed);
  EXPECT_EQ(through.judge(hit_at(1, 1)), Verdict::wrong) << "another triangle";
  EXPECT_EQ(through.judge(hit_at(1.001f, 0)), Verdict::wrong) << "t beyond its bound";
  EXPECT_EQ(through.judge_occlusion(true), Verdict::right);
  EXPECT_EQ(through.judge_occlusion(false), Verdict::missed);

  const Expectation beside = expect({{0.7f, 0.7f, 0}, {0, 0, 1}}, {kTriangle});
  EXPECT_FALSE(beside.doubt || beside.must_hit);
  EXPECT_EQ(beside.judge(std::nullopt), Verdict::right);
  EXPECT_EQ(beside.judge(hit_at(1, 0)), Verdict::wrong);
  EXPECT_EQ(beside.judge_occlusion(true), Verdict::wrong);
}

TEST(Oracle, NamesItsDoubts) {
  const Vec3 up(0, 0, 1);
  EXPECT_EQ(expect({{0.5f, 0, 0}, up}, {kTriangle}).doubt, Doubt::edge);
  EXPECT_EQ(expect({{0, 0, 0}, up}, {kTriangle}).doubt, Doubt::vertex);
  EXPECT_EQ(expect({{-1, 0.2f, 1}, {1, 0, 0}}, {kTriangle}).doubt, Doubt::grazing);
  EXPECT_EQ(expect({{0.2f, 0.2f, 0}, up, 0, 1}, {kTriangle}).doubt, Doubt::range_end);
  EXPECT_EQ(expect({{0.2f, 0.2f, 0}, up}, {kTriangle, kTriangle}).doubt, Doubt::tie);
}

TEST(Oracle, RaysThatAreNoneHitNothing) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Ray& ray : {Ray{{0.2f, 0.2f, 0}, {0, 0, 0}}, Ray{{nan, 0, 0}, {0, 0, 1}},
                         Ray{{0.2f, 0.2f, 0}, {0, 0, 1}, 2, 1}}) {
    EXPECT_EQ(expect(ray, {kTriangle}).judge(hit_at(1, 0)), Verdict::wrong);
    EXPECT_EQ(expect(ray, {kTriangle}).judge(std::nullopt), Verdict::right);
  }
}

/// Either of two triangles at a shared edge may answer, but the ray must not slip through between them, even
/// if there is a wall behind.
TEST(Oracle, ALeakThroughASharedEdgeIsWrong) {
  const Triangle other{{1, 1, 1}, {0, 1, 1}, {1, 0, 1}}, wall{{-9, -9, 5}, {9, -9, 5}, {0, 9, 5}};
  const Expectation e = expect({{0.5f, 0.5f, 0}, {0, 0, 1}}, {kTriangle, other, wall});
  EXPECT_EQ(e.doubt, Doubt::edge);
  EXPECT_TRUE(e.must_hit);
  EXPECT_EQ(e.judge(hit_at(1, 0)), Verdict::right);
  EXPECT_EQ(e.judge(hit_at(1, 1)), Verdict::right);
  EXPECT_EQ(e.judge(hit_at(5, 2)), Verdict::wrong);
  EXPECT_EQ(e.judge(std::nullopt), Verdict::missed);
}

TEST(Oracle, TheOpenEdgeOfOneTriangleMayLeak) {
  const Triangle wall{{-9, -9, 5}, {9, -9, 5}, {0, 9, 5}};
  const Expectation e = expect({{0.5f, 0, 0}, {0, 0, 1}}, {kTriangle, wall});
  EXPECT_EQ(e.judge(hit_at(1, 0)), Verdict::right);
  EXPECT_EQ(e.judge(hit_at(5, 1)), Verdict::right);
  EXPECT_EQ(e.judge(std::nullopt), Verdict::missed) << "there is the wall";
}

/// Triangles around a vertex, wound at random as files do.
std::vector<Triangle> fan(int blades, const Vec3& hub) {
  std::vector<Triangle> triangles;
  const auto rim = [&](int i) {
    const double angle = 2 * std::numbers::pi * (i % blades) / blades;
    return hub + Vec3(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.25f);
  };
  for (int i = 0; i < blades; ++i) {
    triangles.push_back(i % 2 == 0 ? Triangle{hub, rim(i), rim(i + 1)} : Triangle{rim(i + 1), rim(i), hub});
  }
  return triangles;
}

TEST(Oracle, ALeakThroughTheHubOfAFanIsWrong) {
  for (const int blades : {3, 4, 5, 8, 40}) {
    for (const Vec3& hub : {Vec3(0, 0, 2), Vec3(100, 0.1f, 7)}) {
      const Vec3 from = hub - Vec3(0.3f, 0.1f, 2);
      const Expectation e = expect({from, hub - from}, fan(blades, hub));
      EXPECT_EQ(e.doubt, Doubt::vertex) << blades;
      EXPECT_TRUE(e.must_hit) << blades;
      EXPECT_EQ(e.judge(std::nullopt), Verdict::missed);
    }
  }
}

TEST(Oracle, AFanWithAGapMayLeak) {
  std::vector<Triangle> open = fan(5, {0, 0, 2});
  open.pop_back();
  EXPECT_FALSE(expect({{0, 0, 0}, {0, 0, 1}}, open).must_hit);
}

/// The silhouette of a fold: whether the ray meets both sides or neither is a matter of rounding.
TEST(Oracle, ASilhouetteMayBeMissed) {
  const std::vector<Triangle> roof{{{0, -1, 0}, {0, 1, 0}, {1, 0, 1}}, {{0, 1, 0}, {0, -1, 0}, {1, 0, -1}}};
  const Expectation e = expect({{0, 0, -5}, {0, 0, 1}}, roof);
  EXPECT_EQ(e.doubt, Doubt::edge);
  EXPECT_FALSE(e.must_hit);
}

/// What the tree finds is what looking at every triangle finds, and the truth is always admissible: bounds,
/// clusters and boxes agree with rational arithmetic.
TEST(Oracle, TheTruthIsAdmissible) {
  for (const float size : {0.02f, 0.3f, 1.5f}) {
    const auto triangles = test::random_triangles(400, size, 51);
    const Oracle oracle(triangles);
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    int decided = 0;
    for (std::uint32_t i = 0; i < 3000; ++i) {
      Sampler random(52, i, 0);
      const Vec3 from = test::random_point(random) * 1.5f;
      const Triangle& aim = triangles[i % triangles.size()];
      const Vec3 towards = i % 3 == 0   ? test::random_direction(random)
                           : i % 3 == 1 ? aim.v1 - from
                                        : (aim.v0 + aim.v1) * 0.5f - from;
      const Ray ray{from, towards};
      const Expectation e = oracle.expect(ray);
      const auto truth = exact_hit(ray, triangles, all);
      ASSERT_EQ(truth.has_value(), e.exact.has_value()) << i;
      const auto as_hit = truth ? hit_at(static_cast<float>(truth->t), truth->triangle) : std::nullopt;
      ASSERT_EQ(e.judge(as_hit), Verdict::right) << i;
      if (e.doubt) continue;
      ++decided;
      if (truth) {
        ASSERT_EQ(e.admissible.at(0).triangle, truth->triangle);
      }
    }
    EXPECT_GT(decided, 1000);
  }
}

}  // namespace
}  // namespace lemma
