// The stages of path waves by every instruction set that this machine has: the same bits as by the fastest,
// which path_wave_test holds against single paths.

#include <gtest/gtest.h>

#include <cstring>

#include "integrators/vertex_wave.h"
#include "integrators/weight_wave.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

constexpr std::size_t kCount = 250;  // no multiple of a register's lanes

template <class T>
void expect_same(const Wave<T>& a, const Wave<T>& b, const char* what) {
  EXPECT_EQ(std::memcmp(a.values, b.values, kCount * sizeof(T)), 0) << what;
}
void expect_same(const VecWave& a, const VecWave& b, const char* what) {
  expect_same(a.x, b.x, what), expect_same(a.y, b.y, what), expect_same(a.z, b.z, what);
}
void expect_same(const RgbWave& a, const RgbWave& b, const char* what) {
  expect_same(a.r, b.r, what), expect_same(a.g, b.g, what), expect_same(a.b, b.b, what);
}

Rgb random_rgb(Sampler& random) {
  return {random.next(), random.next(), random.next()};
}

/// Rays on random triangles, from both sides, with normals that lean, some of which cancel.
TouchWave random_touches() {
  Sampler random(31, 0, 0);
  const auto triangles = test::random_triangles(kCount, 0.5f, 32);
  TouchWave touches;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3 n = test::random_direction(random);
    touches.set_triangle(i, triangles[i]);
    touches.set_normals(i, {n, i % 7 == 0 ? -n : test::random_direction(random),
                            i % 7 == 0 ? n * 0.0f : test::random_direction(random)});
    touches.direction.set(i, test::random_direction(random));
    touches.b1[i] = 0.5f * random.next(), touches.b2[i] = 0.5f * random.next();
    if (i % 7 == 0) touches.b1[i] = 0.5f, touches.b2[i] = 0;
  }
  return touches;
}

struct FoundVertices {
  VertexWave flat, smooth;
  VecWave local, world;
  Wave<std::uint32_t> above;
};

FoundVertices find_vertices(const VertexStages& stages, const TouchWave& touches) {
  FoundVertices found;
  stages.find_flat(touches, kCount, found.flat);
  stages.find_smooth(touches, kCount, found.smooth);
  stages.to_local(found.smooth, touches.n1, kCount, found.local);
  stages.to_world(found.smooth, touches.n2, kCount, found.world);
  stages.above(found.smooth, touches.n2, kCount, found.above);
  return found;
}

void expect_same(const VertexWave& a, const VertexWave& b) {
  expect_same(a.query.x, b.query.x, "origin"), expect_same(a.query.n, b.query.n, "normal");
  expect_same(a.query.mirror, b.query.mirror, "mirror direction"), expect_same(a.wo, b.wo, "wo");
  expect_same(a.s, b.s, "s"), expect_same(a.t, b.t, "t");
  expect_same(a.geometric, b.geometric, "geometric normal");
}

TEST(StagesWave, VerticesByEveryInstructionSet) {
  const TouchWave touches = random_touches();
  const FoundVertices expected = find_vertices(all_vertex_stages().front(), touches);
  for (const VertexStages& stages : all_vertex_stages()) {
    SCOPED_TRACE(stages.name);
    const FoundVertices found = find_vertices(stages, touches);
    expect_same(found.flat, expected.flat), expect_same(found.smooth, expected.smooth);
    expect_same(found.local, expected.local, "local"), expect_same(found.world, expected.world, "world");
    expect_same(found.above, expected.above, "above");
  }
}

/// Samples of which some do not exist, with densities from 0 to infinity.
struct Weighed {
  LightSampleWave lights;
  BrdfValueWave values;
  BrdfSampleWave samples;
  VecWave local;
  RgbWave throughput;
  Wave<float> pdf_light, u;
};

Weighed random_samples() {
  Sampler random(33, 0, 0);
  Weighed w;
  for (std::size_t i = 0; i < kCount; ++i) {
    w.lights.pdf[i] = i % 5 == 0 ? 0 : std::exp(40 * random.next() - 20);
    w.lights.radiance.set(i, random_rgb(random));
    w.values.f.set(i, i % 6 == 0 ? Rgb{} : random_rgb(random));
    w.values.pdf[i] = i % 4 == 0 ? 0 : std::exp(40 * random.next() - 20);
    w.samples.pdf[i] = i % 9 == 0   ? 0
                       : i % 9 == 1 ? std::numeric_limits<float>::infinity()
                                    : std::exp(40 * random.next() - 20);
    w.samples.weight.set(i, random_rgb(random));
    w.local.set(i, test::random_direction(random));
    w.throughput.set(i, random_rgb(random));
    w.pdf_light[i] = w.lights.pdf[i], w.u[i] = random.next();
  }
  return w;
}

struct FoundWeights {
  ReflectedWave reflected;
  Wave<float> weight;
  RgbWave throughput;
  ContinuedWave continued;
};

FoundWeights weigh(const WeightStages& stages, const Weighed& w, Weighting weighting, Roulette roulette) {
  FoundWeights found;
  found.throughput = w.throughput;
  stages.light(weighting, w.lights, w.values, w.local, w.throughput, kCount, found.reflected);
  stages.emission(weighting, w.samples.pdf, w.pdf_light, kCount, found.weight);
  stages.scatter(roulette, 4, w.samples, kCount, found.throughput, found.continued);
  stages.survive(w.u, kCount, found.throughput, found.continued);
  return found;
}

TEST(StagesWave, WeightsByEveryInstructionSet) {
  const Weighed samples = random_samples();
  for (const Weighting weighting :
       {Weighting::balance, Weighting::power, Weighting::lights, Weighting::brdf}) {
    for (const Roulette roulette : {Roulette::fixed, Roulette::throughput}) {
      const FoundWeights expected = weigh(all_weight_stages().front(), samples, weighting, roulette);
      for (const WeightStages& stages : all_weight_stages()) {
        SCOPED_TRACE(stages.name);
        const FoundWeights found = weigh(stages, samples, weighting, roulette);
        expect_same(found.reflected.reflects, expected.reflected.reflects, "reflects");
        for (std::size_t i = 0; i < kCount; ++i) {
          // Of what is not reflected the contribution means nothing: its NaN may have either sign.
          if (found.reflected.reflects[i] == 0) continue;
          ASSERT_EQ(found.reflected.contribution[i], expected.reflected.contribution[i]);
        }
        expect_same(found.weight, expected.weight, "weight");
        expect_same(found.throughput, expected.throughput, "throughput");
        expect_same(found.continued.alive, expected.continued.alive, "alive");
        expect_same(found.continued.survival, expected.continued.survival, "survival");
      }
    }
  }
}

}  // namespace
}  // namespace lemma
