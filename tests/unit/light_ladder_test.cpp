// What holds for every strategy of light sampling, whatever it knows about the lights: tests run through the
// table of strategies.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/core/warp.h"
#include "src/lights/light_sampler.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"
#include "tests/support/seen_triangles.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

using test::Estimate;

/// Lights and from where they are looked at.
struct Situation {
  std::string_view name;
  std::vector<Emitter> emitters;
  Vec3 x, n;
  bool area_converges = true;  // cosine / distance^2 is bounded by not much more than its mean
  std::size_t parts = 400;     // of all emitters together, for the histogram
};

std::vector<Emitter> one(const Triangle& t) {
  return test::emitters_of({t}, 2, 0);
}

std::vector<Situation> situations() {
  std::vector<Situation> all;
  all.push_back({"two spheres", test::two_spheres(), {0.3f, 0, -0.2f}, {0, 1, 0}});
  all.push_back({"close to a sphere", test::two_spheres(), {0, 1.4f, 0.1f}, normalize(Vec3(0.3f, 1, 0))});
  all.push_back({"inside a sphere's bounds", test::two_spheres(), {0.1f, 2.501f, 0}, {0, -1, 0.0f}, false});
  all.push_back({"random triangles",
                 test::emitters_of(test::random_triangles(80, 0.4f, 121), 1, 0),
                 {0.5f, -0.3f, 0.4f},
                 {0, 1, 0}});
  all.push_back({"among random triangles",
                 test::emitters_of(test::random_triangles(80, 0.4f, 122), 1, 0),
                 {0.5f, 0.5f, 0.4f},
                 {0, 0, 1},
                 false});
  all.push_back(
      {"partly below the horizon", one({{2, -1, 0}, {1, 2, 1}, {2, -2, 2}}), {0, 0, 0.9f}, {0, 1, 0}});
  all.push_back({"two vertices below", one({{1, -1, 0}, {1, 0.5f, 1}, {1, -2, 2}}), {0, 0, 0.9f}, {0, 1, 0}});
  all.push_back(
      {"near a hemisphere", one({{90, 1, -80}, {10, 1, 120}, {-100, 1, -70}}), {0, 0, 0}, {0, 1, 0}, false});
  all.push_back({"by plane and edge",
                 one({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}),
                 {0.001f, 0.01f, 0.4f},
                 normalize(Vec3(-1, -0.2f, 0)),
                 false});
  all.push_back({"a sliver", one({{1, 0.5f, -1}, {1, 0.501f, 0}, {1, 0.5f, 1}}), {0, 0, 0}, {0, 1, 0}});
  all.push_back(
      {"1e-11 sr",
       one({{1, 0.7f, 0.5f}, {1.000003f, 0.700006f, 0.499994f}, {1.0000095f, 0.700001f, 0.5000035f}}),
       {0, 0, 0},
       {0, 1, 0},
       true,
       4});  // float32 directions leave it a hundred steps
  // Two halves of one light, which the tree samples as a whole.
  all.push_back(
      {"a quad",
       test::emitters_of({{{1, 2, 1}, {1.5f, 2, -1}, {1, 1, -1}}, {{1.5f, 2, -1}, {1, 2, 1}, {1.5f, 3, 1}}},
                         2, 0),
       {0.2f, 0.9f, 0.1f},
       normalize(Vec3(1, 0.5f, 0))});
  // Whatever their winding, single triangles shall face x.
  for (Situation& s : all) {
    if (s.emitters.size() > 1) continue;
    Triangle& t = s.emitters.front().shape;
    if (side_of(t, s.x) < 0) std::swap(t.v1, t.v2);
  }
  return all;
}

bool by_area(std::string_view strategy) {
  return strategy == "power" || strategy == "radiance-area";
}

class LightLadder : public testing::TestWithParam<std::string_view> {
 protected:
  [[nodiscard]] static std::unique_ptr<const LightSampler> make(const std::vector<Emitter>& emitters) {
    return find_named(light_samplers(), GetParam()).value()(emitters, {});
  }
  static bool suits(const Situation& s) { return s.area_converges || !by_area(GetParam()); }
};

// For the strategies and situations together.
constexpr double kFalseAlarm = 1e-3;
constexpr int kTests = 5 * 12;

/// cos / distance^2 at the middle of a part.
double solid_angle_per_area(const test::Corners& part, const Vec3d& to_light) {
  const Vec3d normal = normalize(cross(part[1] - part[0], part[2] - part[0]));
  const double distance = length(to_light);
  return std::abs(dot(normal, to_light)) / (distance * distance * distance);
}

/// What a strategy's density is nearly constant with respect to on a part of an emitter.
test::Partition::Measure measure_of(std::string_view strategy) {
  if (by_area(strategy)) return test::area_of;
  return strategy == "projected" ? test::projected_solid_angle_of : test::solid_angle_of;
}

/// The integral of a strategy's density over the parts of an emitter. With respect to the partition's measure
/// it is constant ("projected": everywhere on the emitter), or nearly so on a part.
std::vector<double> integrals(const LightSampler& lights, const LightQuery& at, std::uint32_t emitter,
                              const test::Partition& partition, std::string_view strategy) {
  const bool by_cosine = strategy == "projected";
  const auto parts = partition.parts();
  auto integrals = partition.shares();
  if (!(partition.total() > 0)) return std::vector(parts.size(), 0.0);
  double highest = 0, constant = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Vec3d middle = (parts[i][0] + parts[i][1] + parts[i][2]) * (1 / 3.0);
    const double density = lights.pdf(at, emitter, Vec3(middle)).value;
    const Vec3d to_light = middle - Vec3d(at.x);
    const double cosine = dot(normalize(to_light), Vec3d(at.n));
    if (cosine > highest) highest = cosine, constant = density / cosine;
    integrals[i] *= partition.total() * (by_cosine ? 1 : density);
    if (by_area(strategy)) integrals[i] *= solid_angle_per_area(parts[i], to_light);
  }
  if (by_cosine) {
    for (double& integral : integrals) integral *= constant;
  }
  return integrals;
}

/// Samples by parts of emitters against the integral of pdf() over them; what is left of 1 are samples that
/// come to nothing.
TEST_P(LightLadder, SamplesFollowTheDensityAndNoneIsLeftOver) {
  constexpr std::uint32_t draws = 40000;
  const auto measure = measure_of(GetParam());
  for (const Situation& s : situations()) {
    const auto lights = make(s.emitters);
    const test::LightDraws draw(*lights, s.emitters);
    const LightQuery at = lights->query(s.x, s.n);
    const std::size_t parts = std::max<std::size_t>(s.parts / s.emitters.size(), 1);
    std::vector<test::Partition> partitions;
    std::vector<std::size_t> first;
    std::vector<double> shares;
    double rest = 1;
    for (std::uint32_t e = 0; e < s.emitters.size(); ++e) {
      partitions.emplace_back(test::SeenTriangle{s.name, s.emitters[e].shape, s.x, s.n}, measure, parts);
      first.push_back(shares.size());
      for (const double share : integrals(*lights, at, e, partitions.back(), GetParam())) {
        shares.push_back(share);
        rest -= share;
      }
    }
    // The value errs by the curvature of the density over a part.
    EXPECT_GT(rest, -2e-3) << s.name;
    shares.push_back(std::max(rest, 0.0));
    std::vector<double> counts(shares.size(), 0.0);
    for (std::uint32_t i = 0; i < draws; ++i) {
      Sampler random(131, i, 0);
      const auto sample = draw(at, random);
      const int part = sample ? partitions[sample->emitter].part_seen(Vec3d(sample->to_light)) : 0;
      if (part < 0) continue;  // by an edge, off it by the rounding of to_light
      ++counts[sample ? first[sample->emitter] + static_cast<std::size_t>(part) : counts.size() - 1];
    }
    const double tail = test::chi_square_test(counts, shares);
    EXPECT_GT(tail, kFalseAlarm / kTests) << s.name << ", rest " << rest;
  }
}

/// Lambert's formula for the part of each triangle above the horizon.
TEST_P(LightLadder, EstimatesTheIrradianceOfThePartAboveTheHorizon) {
  for (const Situation& s : situations()) {
    if (!suits(s)) continue;
    const auto lights = make(s.emitters);
    const test::LightDraws draw(*lights, s.emitters);
    const LightQuery at = lights->query(s.x, s.n);
    double reference = 0;
    for (const Emitter& e : s.emitters) reference += test::irradiance(e, s.x, s.n);
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 40000; ++i) {
      Sampler random(132, i, 0);
      const auto sample = draw(at, random);
      values.push_back(sample ? double{sample->radiance.g} * std::max(0.0f, dot(sample->wi, s.n)) /
                                    double{sample->pdf.value}
                              : 0.0);
    }
    const Estimate e = test::estimate(values);
    // Lambert's sum in double cancels for the smallest.
    EXPECT_LT(std::abs(e.mean - reference),
              test::z_limit(kFalseAlarm, kTests) * e.standard_error + 1e-5 * reference)
        << s.name << ": " << e.mean << " +- " << e.standard_error << ", expected " << reference;
  }
}

/// Densities of a sample and of its point agree but for the rounding of the point to float32: relative to the
/// emitter's plane it moves the cosine at the light, which an area density divides by.
TEST_P(LightLadder, SampleAndPdfAgree) {
  for (const Situation& s : situations()) {
    const auto lights = make(s.emitters);
    const test::LightDraws draw(*lights, s.emitters);
    const LightQuery at = lights->query(s.x, s.n);
    int samples = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      Sampler random(133, i, 0);
      const auto sample = draw(at, random);
      if (!sample) continue;
      const Vec3d y = Vec3d(s.x) + Vec3d(sample->to_light);
      const Triangle& t = s.emitters[sample->emitter].shape;
      const double height = side_of(t, s.x) / length(area_vector(t));
      const double cosine = std::abs(double{dot(sample->wi, s.n)});
      const double rounding = 4 * 0x1p-24 * (length(y) + length(Vec3d(sample->to_light)));
      if (cosine < 1e-3) continue;  // at the horizon rounding decides all
      ++samples;
      EXPECT_NEAR(lights->pdf(at, sample->emitter, Vec3(y)).value / sample->pdf.value, 1,
                  1e-5 + rounding / height + 4e-7 / cosine)
          << s.name << " " << i;
    }
    EXPECT_GT(samples, 100) << s.name;
  }
}

/// A diffuse receiver, seen as the mean of its points: F = E / (pi L).
Estimate form_factor(const LightSampler& lights, const Triangle (&receiver)[2], const Vec3& n) {
  std::vector<double> values;
  for (std::uint32_t i = 0; i < 40000; ++i) {
    Sampler random(134, i, 0);
    const Triangle& half = receiver[random.next_bits() & 1u];
    const auto [b1, b2] = uniform_triangle(random.next_2d());
    const auto sample = lights.sample(lights.query(Vec3(point_at(half, b1, b2)), n), random);
    values.push_back(sample ? double{sample->radiance.g} * std::max(0.0f, dot(sample->wi, n)) /
                                  (double{sample->pdf.value} * std::numbers::pi)
                            : 0.0);
  }
  return test::estimate(values);
}

/// Opposite unit squares at distance 1, and unit squares that share an edge; there samples by area have
/// infinite variance. Closed forms: Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-11
/// and C-14; an enclosure: 0.199824896 + 4 x 0.200043776 = 1.
TEST_P(LightLadder, EstimatesFormFactors) {
  const Triangle floor[2] = {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}}, {{0, 0, 0}, {1, 0, 1}, {1, 0, 0}}};
  const Vec3 up(0, 1, 0);
  const double limit = test::z_limit(kFalseAlarm, 10);
  const auto ceiling =
      test::emitters_of({{{0, 1, 0}, {1, 1, 1}, {0, 1, 1}}, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}}}, 1, 0);
  const auto wall =
      test::emitters_of({{{0, 0, 0}, {0, 1, 1}, {0, 0, 1}}, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}}}, 1, 0);
  const Estimate opposite = form_factor(*make(ceiling), floor, up);
  EXPECT_LT(std::abs(opposite.mean - 0.199824896), limit * opposite.standard_error) << opposite.mean;
  EXPECT_LT(opposite.standard_error, 2e-3);
  if (by_area(GetParam())) return;
  const Estimate adjacent = form_factor(*make(wall), floor, up);
  EXPECT_LT(std::abs(adjacent.mean - 0.200043776), limit * adjacent.standard_error) << adjacent.mean;
  EXPECT_LT(adjacent.standard_error, 2e-3);
}

/// E = pi L (R / d)^2 cos(theta) of a sphere above the horizon; that of a mesh in it lies between those of
/// the spheres inside and outside of it.
TEST_P(LightLadder, EstimatesTheIrradianceOfASphere) {
  const Vec3 centre(1, 2, 0.5f), up(0, 1, 0);
  const double distance2 = dot(Vec3d(centre), Vec3d(centre)), cosine = 2 / std::sqrt(distance2);
  const auto mesh = test::sphere_mesh(centre, 0.5f, 40, 80);
  double inner = 0.5;
  for (const Triangle& t : mesh) {
    inner = std::min(inner, -side_of(t, centre) / length(area_vector(t)));
  }
  const auto emitters = test::emitters_of(mesh, 3, 0);
  const auto lights = make(emitters);
  const LightQuery at = lights->query(Vec3(0), up);
  std::vector<double> values;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Sampler random(135, i, 0);
    const auto sample = lights->sample(at, random);
    values.push_back(sample ? 3.0 * sample->wi.y / double{sample->pdf.value} : 0.0);
  }
  const Estimate e = test::estimate(values);
  const double error = test::z_limit(kFalseAlarm, 5) * e.standard_error;
  const auto of_radius = [&](double r) { return 3 * std::numbers::pi * r * r / distance2 * cosine; };
  EXPECT_GT(e.mean + error, of_radius(inner));
  EXPECT_LT(e.mean - error, of_radius(0.5));
  EXPECT_GT(of_radius(inner), 0.99 * of_radius(0.5));
}

/// One triangle, cut by the horizon or not, sampled by the cosine: every sample is the irradiance itself, up
/// to its density in float32 and its cosine at the horizon.
TEST(Projected, IrradianceOfOneTriangleHasNoVariance) {
  for (const Situation& s : situations()) {
    if (s.emitters.size() > 1) continue;
    const auto lights = find_named(light_samplers(), std::string_view("projected")).value()(s.emitters, {});
    const LightQuery at = lights->query(s.x, s.n);
    const double expected = test::exact_projected_solid_angle(test::corners(s.emitters[0].shape), s.x, s.n);
    if (expected < 1e-9) continue;  // sampled by area
    for (std::uint32_t i = 0; i < 1000; ++i) {
      Sampler random(136, i, 0);
      const auto sample = lights->sample(at, random);
      ASSERT_TRUE(sample) << s.name;
      const double cosine = dot(sample->wi, s.n);
      ASSERT_NEAR(cosine / double{sample->pdf.value} / expected, 1, 4e-7 + 4e-7 / cosine) << s.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lights, LightLadder,
                         testing::Values("tree", "radiance-area", "power", "solid-angle", "projected"),
                         [](const auto& name) {
                           std::string id(name.param);
                           std::ranges::replace(id, '-', '_');
                           return id;
                         });

}  // namespace
}  // namespace lemma
