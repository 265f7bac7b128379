// The tree's light sampling for waves against its own for single points.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "src/core/instruction_sets.h"
#include "src/lights/light_sampler.h"
#include "src/lights/light_tree.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using Trees = std::vector<std::unique_ptr<const LightSampler>>;

/// One for each instruction set that this machine has.
Trees trees_over(std::span<const Emitter> emitters) {
  const auto make = find_named(light_samplers(), std::string_view("tree")).value();
  return for_every_instruction_set([&] { return make(emitters, {}); });
}

struct Lights {
  const char* name;
  std::vector<Emitter> emitters;
};

void add(std::vector<Emitter>& emitters, const std::vector<Triangle>& mesh, float radiance) {
  const std::uint32_t light = emitters.empty() ? 0 : emitters.back().light + 1;
  for (const Emitter& e : test::emitters_of(mesh, radiance, light)) emitters.push_back(e);
}

std::vector<Triangle> sphere(const Vec3& centre, float radius) {
  return test::sphere_mesh(centre, radius, 8, 12);
}

/// Facing down.
std::vector<Triangle> quad(const Vec3& corner, float size) {
  const Vec3 a = corner, b = a + Vec3(size, 0.1f * size, 0), c = a + Vec3(0, 0, size), d = b + c - a;
  return {{b, c, a}, {c, b, d}};
}

/// Lights around the cube [0, 1]^3 and within.
std::vector<Lights> rows() {
  std::vector<Lights> all(6);
  all[0].name = "whole light", add(all[0].emitters, sphere({0.5f, 0.6f, 0.4f}, 0.2f), 3);
  all[1].name = "quad", add(all[1].emitters, quad({0.3f, 0.9f, 0.3f}, 0.4f), 5);
  all[2].name = "whole lights", all[3].name = "quads", all[4].name = "whole lights and quads";
  all[5].name = "as many as a node has children";
  for (int k = 0; k < 4; ++k) {
    const auto f = static_cast<float>(k);
    add(all[2].emitters, sphere({0.3f * f, 0.5f, 0.2f * f}, 0.03f + 0.03f * f), 1 + f);
    add(all[3].emitters, quad({0.3f * f, 0.5f + 0.1f * f, 0}, 0.1f + 0.05f * f), 1 + f);
  }
  for (int k = 0; k < 3; ++k) {
    const auto f = static_cast<float>(k);
    add(all[4].emitters, sphere({0.4f * f, 0.2f, 0.3f}, 0.1f), 1 + f);
    add(all[4].emitters, quad({0.4f * f, 0.8f, 0.3f}, 0.2f), 2 + f);
  }
  for (int k = 0; k < 16; ++k) {
    const auto f = static_cast<float>(k);
    add(all[5].emitters,
        k % 2 == 0 ? sphere({0.1f * f, 1.2f, 0.05f * f}, 0.04f) : quad({0.1f * f, 1, 0}, 0.1f), 1 + f);
  }
  return all;
}

/// Points in and around the lights, with lobes of all widths and none.
LightQuery random_query(Sampler& random) {
  LightQuery at;
  at.x = test::random_point(random) * 1.6f - Vec3(0.3f);
  at.n = test::random_direction(random);
  const float width = std::pow(10.0f, -5 * random.next());
  const float peak = random.next() < 0.3f ? 0 : random.next() / width;
  at.reflection = {test::random_direction(random), 0.02f + 0.3f * random.next(), peak, width};
  return at;
}

void set(LightQueryWave& wave, std::size_t lane, const LightQuery& at) {
  wave.x.set(lane, at.x), wave.n.set(lane, at.n), wave.mirror.set(lane, at.reflection.mirror);
  wave.diffuse[lane] = at.reflection.diffuse, wave.peak[lane] = at.reflection.peak;
  wave.width[lane] = at.reflection.width;
}

struct Points {
  LightQueryWave at;
  ChoicePairWave u;
  std::vector<Sampler> random;  // at the number that u holds
};

constexpr std::size_t kPoints = 250;  // no multiple of a register's lanes

Points random_points(std::uint32_t round, std::span<const Emitter> emitters) {
  Points points;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    Sampler random(61, i, round);
    LightQuery at = random_query(random);
    if (i % 4 == 0) {  // where the mirror direction leads to a light
      const Triangle& t = emitters[i % emitters.size()].shape;
      at.reflection.mirror = normalize(Vec3(point_at(t, 0.3, 0.3)) - at.x);
    }
    set(points.at, i, at);
    points.random.push_back(random);
    const auto [x, y] = random.next_choice_pair();
    points.u.x[i] = x, points.u.y[i] = y;
  }
  return points;
}

void expect_equal(const LightSampleWave& samples, std::size_t i, const std::optional<LightSample>& expected) {
  ASSERT_EQ(samples.pdf[i], expected ? expected->pdf.value : 0) << i;
  if (!expected) return;
  ASSERT_EQ(samples.wi[i], expected->wi) << i;
  ASSERT_EQ(samples.to_light[i], expected->to_light) << i;
  ASSERT_EQ(samples.radiance[i], expected->radiance) << i;
  ASSERT_EQ(samples.visible_until[i], expected->visible_until) << i;
  ASSERT_EQ(samples.emitter[i], expected->emitter) << i;
}

TEST(LightRowWave, SamplesAreThoseOfSinglePoints) {
  for (const auto& [name, emitters] : rows()) {
    SCOPED_TRACE(name);
    for (const auto& lights : trees_over(emitters)) {
      ASSERT_NE(lights->waves(), nullptr);
      int sampled = 0;
      for (std::uint32_t round = 0; round < 8; ++round) {
        Points points = random_points(round, emitters);
        LightSampleWave samples;
        lights->waves()->sample_wave(points.at, kPoints, points.u, samples);
        for (std::size_t i = 0; i < kPoints; ++i) {
          const auto expected = lights->sample(points.at[i], points.random[i]);
          ASSERT_NO_FATAL_FAILURE(expect_equal(samples, i, expected));
          if (!expected) continue;
          ASSERT_EQ(samples.whole[i], expected->whole) << i;
          ++sampled;
        }
      }
      EXPECT_GT(sampled, 400);
    }
  }
}

TEST(LightRowWave, DensitiesAreThoseOfSinglePoints) {
  for (const auto& [name, emitters] : rows()) {
    SCOPED_TRACE(name);
    for (const auto& lights : trees_over(emitters)) {
      int positive = 0;
      for (std::uint32_t round = 0; round < 8; ++round) {
        Points points = random_points(round, emitters);
        Wave<std::uint32_t> hit;
        VecWave y;
        Wave<float> pdf;
        for (std::size_t i = 0; i < kPoints; ++i) {
          hit[i] = static_cast<std::uint32_t>((i * 7 + round) % emitters.size());
          y.set(i, Vec3(point_at(emitters[hit[i]].shape, 0.5 * points.u.x[i], 0.5 * double{points.u.y[i]})));
        }
        lights->waves()->pdf_wave(points.at, kPoints, hit, y, pdf);
        for (std::size_t i = 0; i < kPoints; ++i) {
          ASSERT_EQ(pdf[i], lights->pdf(points.at[i], hit[i], y[i]).value) << i;
          if (pdf[i] > 0) ++positive;
        }
      }
      EXPECT_GT(positive, 200);
    }
  }
}

/// At the ends of the range of their numbers samples are the same for all instruction sets, and finite.
TEST(LightRowWave, SamplesAtTheEndsOfTheRange) {
  constexpr double last = 1 - 0x1p-53;
  constexpr float last_y = 1 - 0x1p-24f;
  for (const auto& [name, emitters] : rows()) {
    SCOPED_TRACE(name);
    const Trees trees = trees_over(emitters);
    Points points = random_points(1, emitters);
    for (std::size_t i = 0; i < kPoints; ++i) {
      points.u.x[i] = i % 2 == 0 ? 0 : last, points.u.y[i] = i % 3 == 0 ? 0 : last_y;
    }
    LightSampleWave expected;
    trees.back()->waves()->sample_wave(points.at, kPoints, points.u, expected);
    for (const auto& lights : trees) {
      LightSampleWave samples;
      lights->waves()->sample_wave(points.at, kPoints, points.u, samples);
      for (std::size_t i = 0; i < kPoints; ++i) {
        ASSERT_EQ(samples.pdf[i], expected.pdf[i]) << i;
        if (samples.pdf[i] == 0) continue;
        EXPECT_TRUE(std::isfinite(samples.pdf[i])) << i;
        EXPECT_NEAR(length(samples.wi[i]), 1, 1e-6) << i;
        ASSERT_EQ(samples.wi[i], expected.wi[i]) << i;
        ASSERT_EQ(samples.to_light[i], expected.to_light[i]) << i;
        ASSERT_EQ(samples.emitter[i], expected.emitter[i]) << i;
      }
    }
  }
}

TEST(LightRowWave, IsNoneOverTreesOfManyLightsOrEmitters) {
  std::vector<Emitter> many;
  for (int k = 0; k < 17; ++k) add(many, sphere({static_cast<float>(k), 0, 0}, 0.1f), 1);
  std::vector<Emitter> with_triangle = test::two_spheres();
  add(with_triangle, {{{0, 9, 0}, {1, 9, 0}, {0, 9, 1}}}, 1);
  for (const auto& emitters : {many, with_triangle}) EXPECT_FALSE(LightTree(emitters, {}).row());
  EXPECT_TRUE(LightTree(test::two_spheres(), {}).row());
}

}  // namespace
}  // namespace lemma
