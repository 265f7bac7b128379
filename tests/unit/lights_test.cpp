#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "src/core/warp.h"
#include "src/lights/light_sampler.h"
#include "src/lights/spherical_triangle.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

using test::emitters_of;
using test::two_spheres;

const Vec3 kUp(0, 1, 0);

class EveryStrategy : public testing::TestWithParam<std::string_view> {
 protected:
  [[nodiscard]] std::unique_ptr<const LightSampler> make(const std::vector<Emitter>& emitters) const {
    return find_named(light_samplers(), GetParam()).value()(emitters, {});
  }
};

TEST_P(EveryStrategy, SampleAndPdfAgree) {
  const auto emitters = two_spheres();
  const auto lights = make(emitters);
  const test::LightDraws draw(*lights, emitters);
  const LightQuery at = lights->query({0.3f, 0, -0.2f}, kUp);
  int samples = 0;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    Sampler random(21, i, 0);
    const auto sample = draw(at, random);
    if (!sample) continue;
    ++samples;
    const Vec3 y = at.x + sample->to_light;
    // to_light is rounded to float: the cosine and the distance move by a few roundings over the cosine.
    EXPECT_NEAR(sample->pdf.value / lights->pdf(at, sample->emitter, y).value, 1, 1e-3) << i;
    ASSERT_TRUE(sample->whole != nullptr || (sample->visible_until > 0.98f && sample->visible_until < 1));
  }
  EXPECT_GT(samples, 1000);
}

/// The mean of radiance x cos / pdf over samples is the irradiance of a floor under the lights, which a
/// sphere above the horizon gives in closed form up to its tessellation: here Lambert's sum over the emitting
/// triangles is the reference.
TEST_P(EveryStrategy, EstimatesTheIrradianceOfUnoccludedTriangles) {
  const auto emitters = two_spheres();
  const auto lights = make(emitters);
  const test::LightDraws draw(*lights, emitters);
  const Vec3 x(0.3f, 0, -0.2f);
  double reference = 0;
  for (const Emitter& e : emitters) reference += test::irradiance(e, x, kUp);
  const LightQuery at = lights->query(x, kUp);
  std::vector<double> values;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Sampler random(22, i, 0);
    const auto sample = draw(at, random);
    values.push_back(sample ? double{sample->radiance.g} * sample->wi.y / sample->pdf.value : 0.0);
  }
  const test::Estimate estimate = test::estimate(values);
  // False alarms: one in 10^4 for the strategies together.
  EXPECT_LT(std::abs(estimate.mean - reference) / estimate.standard_error, test::z_limit(1e-4, 5))
      << estimate.mean << " +- " << estimate.standard_error << ", expected " << reference;
}

TEST_P(EveryStrategy, NothingFromBehindAndNothingInThePlane) {
  const std::vector<Emitter> one{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {1, 1, 1}, 0, 0}};  // emits towards +z
  const auto lights = make(one);
  for (const Vec3& x : {Vec3(0.2f, 0.2f, -1), Vec3(3, 3, 0)}) {
    const LightQuery at = lights->query(x, kUp);
    Sampler random(23, 0, 0);
    EXPECT_FALSE(lights->sample(at, random));
    EXPECT_EQ(lights->pdf(at, 0, {0.2f, 0.2f, 0}).value, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Lights, EveryStrategy,
                         testing::Values("tree", "radiance-area", "power", "solid-angle", "projected"),
                         [](const auto& name) {
                           std::string id(name.param);
                           std::ranges::replace(id, '-', '_');
                           return id;
                         });

TEST(RadianceArea, ChoosesLightsByRadianceAlone) {
  const auto emitters = two_spheres();
  const auto lights = find_named(light_samplers(), std::string_view("radiance-area")).value()(emitters, {});
  const LightQuery at = lights->query({0, 100, 0}, -kUp);  // sees about the same half of both
  std::map<float, int> chosen;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Sampler random(24, i, 0);
    if (const auto sample = lights->sample(at, random)) ++chosen[sample->radiance.g];
  }
  // 40 : 3 of those that face x, which is nearly half of either; binomial, 5 standard deviations.
  const double share = static_cast<double>(chosen[40]) / (chosen[40] + chosen[3]);
  EXPECT_NEAR(share, 40.0 / 43, 5 * std::sqrt(0.07 * 0.93 / 10000) + 0.005);
}

TEST(SphericalTriangle, SolidAngleOfAnOctant) {
  const SphericalTriangle octant({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0});
  EXPECT_NEAR(octant.solid_angle(), M_PI / 2, 1e-15);
}

TEST(SphericalTriangle, ClosedMeshCoversTheWholeSphere) {
  double sum = 0;
  const Vec3 inside(0.3f, -0.2f, 0.1f);
  for (const Triangle& t : test::sphere_mesh({0, 0, 0}, 1, 20, 20))
    sum += SphericalTriangle(t, inside).solid_angle();
  EXPECT_NEAR(sum / (4 * M_PI), 1, 1e-12);
}

/// The first moment of directions over a spherical triangle is half the sum of its edges' angle x normal
/// vectors: a closed form for the mean direction of uniform samples.
TEST(SphericalTriangle, SamplesAreInsideAndHaveTheRightMean) {
  const Triangle shapes[] = {{{1, 0.2f, 0}, {-0.3f, 1, 0.1f}, {0.2f, -0.1f, 1}},
                             {{5, 5, 1}, {-5, 5, 1}, {0, -7, 1}},
                             {{0.01f, 0, 1}, {0, 0.01f, 1}, {-0.01f, -0.01f, 1}}};
  for (const Triangle& shape : shapes) {
    const SphericalTriangle triangle(shape, {0, 0, 0});
    ASSERT_TRUE(triangle.can_be_sampled());
    const Vec3d v[3] = {normalize(Vec3d(shape.v0)), normalize(Vec3d(shape.v1)), normalize(Vec3d(shape.v2))};
    Vec3d moment(0);
    for (int i = 0; i < 3; ++i) {
      const Vec3d c = cross(v[i], v[(i + 1) % 3]);
      moment += normalize(c) * (0.5 * std::atan2(length(c), dot(v[i], v[(i + 1) % 3])));
    }
    if (dot(moment, v[0]) < 0) moment = -moment;
    const Vec3d expected = moment * (1 / triangle.solid_angle());

    constexpr int draws = 40000;
    std::vector<double> along[3];
    Sampler random(25, 0, 0);
    const double side = dot(cross(v[0], v[1]), v[2]) > 0 ? 1 : -1;
    for (int i = 0; i < draws; ++i) {
      const Vec3d w = triangle.sample(random.next_2d());
      for (int k = 0; k < 3; ++k) {
        ASSERT_GT(side * dot(cross(v[k], v[(k + 1) % 3]), w), -1e-9);
        along[k].push_back(w[k]);
      }
    }
    for (int k = 0; k < 3; ++k) {
      const test::Estimate e = test::estimate(along[k]);
      // One false alarm in 10^4 runs of the nine tests.
      EXPECT_LT(std::abs(e.mean - expected[k]), test::z_limit(1e-4, 9) * e.standard_error + 1e-12);
    }
  }
}

TEST(SphericalTriangle, CoversNothingSeenFromItsPlane) {
  const Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.5f, 0.5f, 0), Vec3(0.2f, 0.2f, 0), Vec3(3, 0, 0)}) {
    EXPECT_EQ(SphericalTriangle(t, x).solid_angle(), 0);
    EXPECT_FALSE(SphericalTriangle(t, x).can_be_sampled());
  }
}

}  // namespace
}  // namespace lemma
