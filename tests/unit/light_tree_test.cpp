#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/lights/light_sampler.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/spherical_triangle.h"
#include "src/lights/whole_light.h"
#include "tests/support/images.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

using test::emitters_of;

std::unique_ptr<const LightSampler> make_tree(std::span<const Emitter> emitters) {
  return find_named(light_samplers(), std::string_view("tree")).value()(emitters);
}

/// Whether a point of the triangle emits towards x and lies above the horizon of n.
bool can_contribute(const Emitter& e, const Vec3& x, const Vec3& n) {
  return test::irradiance(e, x, n) > 0;
}

Vec3 middle(const Triangle& t) {
  return Vec3(point_at(t, 1 / 3.0, 1 / 3.0));
}

std::vector<Emitter> random_emitters(std::size_t count, float size) {
  return emitters_of(test::random_triangles(count, size, 41), 1, 0);
}

TEST(WholeLight, IsARoundClosedBody) {
  const auto sphere = test::sphere_mesh({1, 2, 3}, 0.5f, 12, 16);
  const auto lights = find_whole_lights(emitters_of(sphere, 1, 0));
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].emitters.size(), sphere.size());
  EXPECT_NEAR(lights[0].radius, 0.5, 2e-6);
  EXPECT_EQ(find_whole_lights(test::two_spheres()).size(), 2u);
}

TEST(WholeLight, IsNothingOpenFlatInwardDoubledOrOfTwoLights) {
  const auto sphere = test::sphere_mesh({1, 2, 3}, 0.5f, 12, 16);
  auto open = sphere, inward = sphere, doubled = sphere, flat = sphere;
  open.pop_back();
  for (Triangle& t : inward) std::swap(t.v1, t.v2);
  doubled.insert(doubled.end(), sphere.begin(), sphere.end());
  for (Triangle& t : flat) t.v0.y *= 0.5f, t.v1.y *= 0.5f, t.v2.y *= 0.5f;
  for (const auto& mesh : {open, inward, doubled, flat}) {
    EXPECT_TRUE(find_whole_lights(emitters_of(mesh, 1, 0)).empty());
  }
  auto two_lights = emitters_of(sphere, 1, 0);
  two_lights.front().light = 1;
  EXPECT_TRUE(find_whole_lights(two_lights).empty());
}

/// The Jacobian of the map, by central differences, is the solid angle.
TEST(SphereCone, DensityIsTheInverseJacobian) {
  for (const double radius : {1e-5, 0.1, 0.98}) {
    const SphereCone cone({0.6, 0, 0.8}, radius, {0, 0, 0});
    ASSERT_TRUE(cone.can_be_sampled());
    for (const Vec2& u : {Vec2(0.25f, 0.25f), Vec2(0.5f, 0.75f), Vec2(0.75f, 0.125f)}) {
      constexpr float h = 0x1p-10f;
      const Vec3d du = (cone.sample(u + Vec2(h, 0)) - cone.sample(u - Vec2(h, 0))) * (0.5 / h);
      const Vec3d dv = (cone.sample(u + Vec2(0, h)) - cone.sample(u - Vec2(0, h))) * (0.5 / h);
      // Central differences err by h^2 / 6 x the third derivatives, here up to (2 pi)^3.
      EXPECT_NEAR(length(cross(du, dv)) / cone.solid_angle(), 1, 5e-5);
    }
  }
}

TEST(SphereCone, SamplesStayInTheConeAtTheExtremesOfU) {
  constexpr float last = 1 - 0x1p-24f;
  for (const double radius : {1e-7, 0.3, 0.985}) {
    const Vec3d centre(0, 0.6, -0.8);
    const SphereCone cone(centre, radius, {0, 0, 0});
    for (const Vec2& u : {Vec2(0, 0), Vec2(last, 0), Vec2(0, last), Vec2(last, last)}) {
      const Vec3d w = cone.sample(u);
      EXPECT_NEAR(length(w), 1, 1e-15);
      EXPECT_LE(length(cross(w, centre)), radius * (1 + 1e-8));
    }
  }
}

TEST(SphereCone, MeanCosineIsPositiveExactlyAboveTheHorizon) {
  const SphereCone cone({0, 0, 1}, 0.5, {0, 0, 0});  // half angle 30 degrees
  const auto tilted = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Vec3d(std::sin(angle), 0, std::cos(angle));
  };
  EXPECT_NEAR(cone.mean_cosine(tilted(0)), (1 + std::cos(std::numbers::pi / 6)) / 2, 1e-15);
  EXPECT_GT(cone.mean_cosine(tilted(119.99)), 0);
  EXPECT_EQ(cone.mean_cosine(tilted(120.01)), 0);
}

TEST(Tree, EveryEmitterThatCanContributeHasAPositiveDensity) {
  auto emitters = random_emitters(3000, 0.1f);
  for (const Emitter& e : test::two_spheres()) emitters.push_back(e);
  const auto lights = make_tree(emitters);
  Sampler random(42, 0, 0);
  int contributing = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3 x = test::random_point(random) * 2 - Vec3(0.5f), n = test::random_direction(random);
    const LightQuery at = lights->query(x, n);
    for (std::uint32_t e = 0; e < emitters.size(); ++e) {
      if (!can_contribute(emitters[e], x, n)) continue;
      ++contributing;
      EXPECT_GT(lights->pdf(at, e, middle(emitters[e].shape)).value, 0) << x << " " << n << " " << e;
    }
  }
  EXPECT_GT(contributing, 10000);
}

/// The emitters that samples end on against density x solid angle: constant over each triangle, both where it
/// is sampled by itself and, on convex bodies, as a part of a whole. What is left of 1 are directions that
/// pass a whole light by. False alarms: one in 10^4 for the four points together.
TEST(Tree, SamplesFollowTheDensity) {
  auto emitters = random_emitters(100, 0.3f);
  for (const Emitter& e : test::two_spheres()) emitters.push_back(e);
  const auto lights = make_tree(emitters);
  constexpr int draws = 200000, points = 4;
  const Vec3 queries[points] = {{0.3f, -1, -0.2f}, {0.5f, 0.5f, 0.5f}, {0, 1.4f, 0}, {2, 2.2f, 1}};
  for (const Vec3& x : queries) {
    const LightQuery at = lights->query(x, {0, 1, 0});
    std::vector<int> counts(emitters.size() + 1);
    for (std::uint32_t i = 0; i < draws; ++i) {
      Sampler random(43, i, 0);
      const auto sample = lights->sample(at, random);
      ++counts[sample ? sample->emitter : emitters.size()];
    }
    double statistic = 0, rest = 1, rare_expected = 0, rare = 0;
    int cells = 0;
    const auto compare = [&](double expected, double seen) {
      statistic += (seen - expected) * (seen - expected) / expected;
      ++cells;
    };
    for (std::uint32_t e = 0; e < emitters.size(); ++e) {
      const Triangle& t = emitters[e].shape;
      const double share =
          double{lights->pdf(at, e, middle(t)).value} * SphericalTriangle(t, x).solid_angle();
      rest -= share;
      if (share * draws < 5) {
        rare_expected += share * draws, rare += counts[e];
      } else {
        compare(share * draws, counts[e]);
      }
    }
    EXPECT_GT(rest, -1e-4);
    if (rare_expected >= 5) compare(rare_expected, rare);
    if (rest * draws >= 5) compare(rest * draws, counts.back());
    EXPECT_GT(test::chi_square_tail(statistic, cells - 1), 1e-4 / points) << x << " " << cells << " cells";
  }
}

/// Unshadowed direct light of the Veach scene: the variance of a sample, relative to its squared mean, is
/// 0.005 to 0.044 for the exact solid angle of all 3040 triangles (closed form sums), and 2 to 3 for `power`.
TEST(Tree, IsNearlyAsGoodAsTheExactSolidAngleOnTheVeachScene) {
  const Scene scene = test::own_scene("veach-mis", 16, 9);
  const auto lights = make_tree(scene.emitters);
  struct Point {
    Vec3 x, n;
  };
  for (const Point& p : {Point{{-5, 6, 0}, {1, 0, 0}}, Point{{-5, 1, 8}, {1, 0, 0}},
                         Point{{4, 0, 0}, {0, 1, 0}}, Point{{12, 0, -15}, {0, 1, 0}}}) {
    const LightQuery at = lights->query(p.x, p.n);
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 20000; ++i) {
      Sampler random(44, i, 0);
      const auto s = lights->sample(at, random);
      values.push_back(s ? double{luminance(s->radiance)} * dot(s->wi, p.n) / double{s->pdf.value} : 0.0);
    }
    const test::Estimate e = test::estimate(values);
    const double relative_variance = std::pow(e.standard_error / e.mean, 2) * e.count;
    EXPECT_LT(relative_variance, 0.05) << p.x;
  }
}

}  // namespace
}  // namespace lemma
