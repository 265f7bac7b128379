#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/core/frame.h"
#include "src/lights/light_sampler.h"
#include "src/lights/quad_light.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/spherical_triangle.h"
#include "src/lights/whole_light.h"
#include "src/shading/phong.h"
#include "tests/support/images.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

using test::emitters_of;

std::unique_ptr<const LightSampler> make_tree(std::span<const Emitter> emitters) {
  return find_named(light_samplers(), std::string_view("tree")).value()(emitters, {});
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
  const auto lights = find_whole_lights(emitters_of(sphere, 1, 0), {});
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].emitters.size(), sphere.size());
  EXPECT_NEAR(lights[0].radius, 0.5, 2e-6);
  EXPECT_EQ(find_whole_lights(test::two_spheres(), {}).size(), 2u);
}

TEST(WholeLight, IsNothingOpenFlatInwardDoubledOrOfTwoLights) {
  const auto sphere = test::sphere_mesh({1, 2, 3}, 0.5f, 12, 16);
  auto open = sphere, inward = sphere, doubled = sphere, flat = sphere;
  open.pop_back();
  for (Triangle& t : inward) std::swap(t.v1, t.v2);
  doubled.insert(doubled.end(), sphere.begin(), sphere.end());
  for (Triangle& t : flat) t.v0.y *= 0.5f, t.v1.y *= 0.5f, t.v2.y *= 0.5f;
  for (const auto& mesh : {open, inward, doubled, flat}) {
    EXPECT_TRUE(find_whole_lights(emitters_of(mesh, 1, 0), {}).empty());
  }
  auto two_lights = emitters_of(sphere, 1, 0);
  two_lights.front().light = 1;
  EXPECT_TRUE(find_whole_lights(two_lights, {}).empty());
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

/// A parallelogram cut along a diagonal, which starts at these corners of its halves.
std::vector<Triangle> parallelogram() {
  const Vec3 a(0, 2, 0), b(1, 2, 0.25f), c(0.5f, 2, 1), d = b + c - a;
  return {{b, c, a}, {c, b, d}};
}

TEST(QuadLight, IsTwoHalvesOfAParallelogram) {
  const auto found = [](const std::vector<Emitter>& emitters) {
    return find_quad_lights(emitters, std::vector<bool>(emitters.size(), true)).size();
  };
  const auto halves = parallelogram();
  EXPECT_EQ(found(emitters_of(halves, 1, 0)), 1u);
  auto kite = halves, bent = halves, reversed = halves;
  kite[1].v2 += Vec3(0.1f, 0, 0);
  bent[1].v2 += Vec3(0, 0.1f, 0);
  std::swap(reversed[1].v0, reversed[1].v1);
  for (const auto& mesh : {kite, bent, reversed, {halves[0]}, {halves[0], halves[0]}}) {
    EXPECT_EQ(found(emitters_of(mesh, 1, 0)), 0u);
  }
  auto two_lights = emitters_of(halves, 1, 0);
  two_lights.front().light = 1;
  EXPECT_EQ(found(two_lights), 0u);
  EXPECT_TRUE(find_quad_lights(emitters_of(halves, 1, 0), {true, false}).empty());
}

/// Points go by one linear map from the square to the parallelogram, across its diagonal too; the density by
/// area is the inverse of its area.
TEST(QuadLight, IsALinearImageOfTheSquare) {
  const auto emitters = emitters_of(parallelogram(), 1, 0);
  const auto quads = find_quad_lights(emitters, {true, true});
  ASSERT_EQ(quads.size(), 1u);
  const auto at = [&](float s, float t) { return quads[0].sample({s, t}); };
  const Vec3d origin = at(0, 0).y, along_s = at(1, 0).y - origin, along_t = at(0, 1).y - origin;
  for (const auto& [s, t] : {std::pair(0.25f, 0.5f), {0.5f, 0.5f}, {0.75f, 0.5f}, {1.0f, 1.0f}}) {
    EXPECT_LT(length(at(s, t).y - (origin + along_s * s + along_t * t)), 1e-7) << s << " " << t;
    EXPECT_EQ(at(s, t).emitter == at(0, 0).emitter, s + t <= 1);
  }
  const double quad_area = length(cross(along_s, along_t));
  for (const std::uint32_t e : {0u, 1u}) {
    // From a point straight below, at distance 2, where density by area is density by angle / 4.
    const Connection straight{{0, 2, 0}, 4, 1, 2};
    EXPECT_NEAR(double{quads[0].pdf(0.5, e, straight).value}, 0.5 * 4 / quad_area, 1e-6);
  }
}

/// A query of a surface that mirrors light from `mirror`, with kd 0: in cos^n, or all alike for n < 0.
LightQuery query_of(const LightSampler& lights, const Vec3& x, const Vec3& n, const Vec3& mirror,
                    float exponent) {
  LightQuery at{x, n};
  if (exponent >= 0) at.reflection = outline(make_material({}, {0.5f, 0.5f, 0.5f}, exponent), mirror);
  lights.prepare(at);
  return at;
}

TEST(Tree, EveryEmitterThatCanContributeHasAPositiveDensity) {
  auto emitters = random_emitters(3000, 0.1f);
  for (const Emitter& e : test::two_spheres()) emitters.push_back(e);
  const auto lights = make_tree(emitters);
  Sampler random(42, 0, 0);
  int contributing = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3 x = test::random_point(random) * 2 - Vec3(0.5f), n = test::random_direction(random);
    for (const float exponent : {-1.0f, 0.0f, 100.0f, 1e6f}) {
      const LightQuery at = query_of(*lights, x, n, test::random_direction(random), exponent);
      for (std::uint32_t e = 0; e < emitters.size(); ++e) {
        if (!can_contribute(emitters[e], x, n)) continue;
        ++contributing;
        EXPECT_GT(lights->pdf(at, e, middle(emitters[e].shape)).value, 0)
            << x << " " << n << " " << e << " " << exponent;
      }
    }
  }
  EXPECT_GT(contributing, 40000);
}

/// The integral of the density over a part of an emitter, cut into four `cuts` times: over each of the small
/// ones it is taken for constant, as it is but where emitters far away are sampled by area.
double integral(const LightSampler& lights, const LightQuery& at, std::uint32_t emitter, const Triangle& part,
                int cuts) {
  if (cuts == 0) {
    return double{lights.pdf(at, emitter, middle(part)).value} * SphericalTriangle(part, at.x).solid_angle();
  }
  const Vec3 a = (part.v1 + part.v2) * 0.5f, b = (part.v2 + part.v0) * 0.5f, c = (part.v0 + part.v1) * 0.5f;
  double sum = 0;
  for (const Triangle& t : {Triangle{part.v0, c, b}, {c, part.v1, a}, {b, a, part.v2}, {a, b, c}}) {
    sum += integral(lights, at, emitter, t, cuts - 1);
  }
  return sum;
}

/// The emitters that samples end on against the integral of the density over them, both where one is sampled
/// by itself and, on convex bodies, as a part of a whole. What is left of 1 are directions that
/// pass a whole light by. False alarms: one in 10^4 for the four points and three lobes together.
TEST(Tree, SamplesFollowTheDensity) {
  auto emitters = random_emitters(100, 0.3f);
  for (const Emitter& e : test::two_spheres()) emitters.push_back(e);
  for (const Emitter& e : emitters_of(parallelogram(), 1, 0)) emitters.push_back(e);
  const auto lights = make_tree(emitters);
  const test::LightDraws draw(*lights, emitters);
  constexpr int draws = 200000;
  struct Case {
    Vec3 x;
    float exponent;
  };
  std::vector<Case> cases;
  for (const Vec3& x : {Vec3(0.3f, -1, -0.2f), Vec3(0.5f, 0.5f, 0.5f), Vec3(0, 1.4f, 0), Vec3(2, 2.2f, 1)}) {
    for (const float exponent : {-1.0f, 3.0f, 1000.0f}) cases.push_back({x, exponent});
  }
  for (const auto& [x, exponent] : cases) {
    const Vec3 mirror = normalize(Vec3(1.7f, 3.2f, 0.9f) - x);
    const LightQuery at = query_of(*lights, x, {0, 1, 0}, mirror, exponent);
    std::vector<int> counts(emitters.size() + 1);
    for (std::uint32_t i = 0; i < draws; ++i) {
      Sampler random(43, i, 0);
      const auto sample = draw(at, random);
      ++counts[sample ? sample->emitter : emitters.size()];
    }
    const int cuts = exponent > 100 ? 5 : 2;  // the lobe changes the density within an emitter
    double statistic = 0, rest = 1, rare_expected = 0, rare = 0;
    int cells = 0;
    const auto compare = [&](double expected, double seen) {
      statistic += (seen - expected) * (seen - expected) / expected;
      ++cells;
    };
    for (std::uint32_t e = 0; e < emitters.size(); ++e) {
      const double share = integral(*lights, at, e, emitters[e].shape, cuts);
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
    EXPECT_GT(test::chi_square_tail(statistic, cells - 1), 1e-4 / static_cast<double>(cases.size()))
        << x << " " << exponent << " " << cells << " cells";
  }
}

/// Unshadowed direct light of the Veach scene: the variance of a sample, relative to its squared mean, is
/// 0.005 to 0.044 for the exact solid angle of all 3040 triangles (closed form sums), and 2 to 3 for `power`.
TEST(Tree, IsNearlyAsGoodAsTheExactSolidAngleOnTheVeachScene) {
  const Scene scene = test::own_scene("veach-mis", 16, 9);
  const auto lights = make_tree(scene.emitters);
  const test::LightDraws draw(*lights, scene.emitters);
  struct Point {
    Vec3 x, n;
  };
  for (const Point& p : {Point{{-5, 6, 0}, {1, 0, 0}}, Point{{-5, 1, 8}, {1, 0, 0}},
                         Point{{4, 0, 0}, {0, 1, 0}}, Point{{12, 0, -15}, {0, 1, 0}}}) {
    const LightQuery at = lights->query(p.x, p.n);
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 20000; ++i) {
      Sampler random(44, i, 0);
      const auto s = draw(at, random);
      values.push_back(s ? double{luminance(s->radiance)} * dot(s->wi, p.n) / double{s->pdf.value} : 0.0);
    }
    const test::Estimate e = test::estimate(values);
    const double relative_variance = std::pow(e.standard_error / e.mean, 2) * e.count;
    EXPECT_LT(relative_variance, 0.05) << p.x;
  }
}

/// In the middle of the mirrored cone the lobe's mean is (1 - e^-t) / t, t = cone over lobe; the outline says
/// 1 / (1 + t), which is 0.77 of it at t = 1.8 and nearer elsewhere.
TEST(Reflection, MeanInTheMiddleOfTheLobe) {
  const Reflection lobe{.mirror = {0, 0, 1}, .diffuse = 0, .peak = 10, .width = 1e-3f};
  for (const double t : {0.01, 0.3, 1.0, 1.8, 5.0, 100.0}) {
    const double ratio =
        double{lobe.mean({0, 0, 1}, static_cast<float>(1e-3 * t))} * t / -std::expm1(-t) / 10;
    EXPECT_GT(ratio, 0.769) << t;
    EXPECT_LT(ratio, 1 + 1e-5) << t;
  }
}

/// Where a plate of the Veach scene mirrors its smallest light, a choice by irradiance picks that light,
/// which is nearly all one sees there, about once in four times: the relative variance is about 3.
TEST(Tree, ChoosesWhatAGlossySurfaceMirrors) {
  const Scene scene = test::own_scene("veach-mis", 16, 9);
  const auto lights = make_tree(scene.emitters);
  const test::LightDraws draw(*lights, scene.emitters);
  const Vec3 x(7, 1.9f, 2.3f), n = normalize(Vec3(0.25f, 1, 0)), wi = normalize(Vec3(0, 6.5f, 4.7f) - x);
  const Vec3 wo = n * (2 * dot(n, wi)) - wi;
  const Material material = make_material({0.1f, 0.1f, 0.1f}, {0.1f, 0.1f, 0.1f}, 500);
  const Frame frame = frame_around(n);
  const auto relative_variance = [&](bool knows) {
    LightQuery at{x, n};
    if (knows) at.reflection = outline(material, wi);
    lights->prepare(at);
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 20000; ++i) {
      Sampler random(45, i, 0);
      const auto s = draw(at, random);
      const auto f = [&] { return Phong<true>(material).eval(frame.to_local(wo), frame.to_local(s->wi)); };
      values.push_back(s ? double{s->radiance.g * f().g} * dot(s->wi, n) / double{s->pdf.value} : 0.0);
    }
    const test::Estimate e = test::estimate(values);
    return std::pow(e.standard_error / e.mean, 2) * e.count;
  };
  EXPECT_GT(relative_variance(false), 1.5);
  EXPECT_LT(relative_variance(true), 0.15);
}

}  // namespace
}  // namespace lemma
