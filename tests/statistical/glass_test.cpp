// Glass: the transmission of a slab against its closed form, and all estimators against each other.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/support/images.h"

namespace lemma {
namespace {

using test::Estimate;

constexpr double kFalseAlarm = 1e-3;
constexpr int kSeeds = 32;

void add_square(Scene& scene, float z, float half, std::uint32_t material, bool facing_up) {
  const Vec3 a(-half, -half, z), b(half, -half, z), c(half, half, z), d(-half, half, z);
  const Triangle lower = facing_up ? Triangle{a, b, c} : Triangle{a, c, b};
  const Triangle upper = facing_up ? Triangle{a, c, d} : Triangle{a, d, c};
  for (const Triangle& t : {lower, upper}) {
    scene.triangles.push_back(t);
    scene.facets.push_back({material, kNoEmitter});
  }
}

/// A camera that looks straight down through a slab of glass on a light of radiance 1; all else is black.
Scene slab(float ior, float tint) {
  Scene scene;
  scene.view = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 0.2, 4, 4};
  add_square(scene, 1, 1, 0, true);
  add_square(scene, 0.9f, 1, 0, false);
  add_square(scene, 0, 1, 1, true);
  for (std::uint32_t t = 4; t < 6; ++t) {
    scene.facets[t].emitter = t - 4;
    scene.emitters.push_back({scene.triangles[t], {1, 1, 1}, t, 0});
  }
  scene.materials = {make_material({}, {}, 1), make_material({}, {}, 1)};
  scene.glass = {Dielectric{ior, {tint, tint, tint}}, Dielectric{}};
  scene.needs.model.glass = true;
  scene.needs.lights = 1;
  scene.needs.emitter_triangles = 2;
  return scene;
}

/// At normal incidence R = ((n - 1) / (n + 1))^2 and light goes to and fro in the slab: tint^2 (1 - R)^2 / (1
/// - R^2). The camera's rays are off by 2e-3 at most, which changes R by its square.
TEST(Glass, SlabTransmitsWhatTheSeriesSays) {
  const double limit = test::t_limit(kFalseAlarm, 4, kSeeds - 1);
  for (const auto& [ior, tint] :
       {std::pair(1.5f, 1.0f), std::pair(1.5f, 0.8f), std::pair(3.0f, 1.0f), std::pair(3.0f, 0.5f)}) {
    IntegratorOptions options;
    const Estimate e = test::mean_over_seeds(
        slab(ior, tint), {"grid", "mis", "power", options, Sequence::independent}, 256, 0, kSeeds);
    const double r = std::pow((double{ior} - 1) / (double{ior} + 1), 2);
    const double expected = double{tint} * double{tint} * (1 - r) * (1 - r) / (1 - r * r);
    std::printf("n %.1f tint %.1f: %.5f +- %.5f, expected %.5f\n", double{ior}, double{tint}, e.mean,
                e.standard_error, expected);
    EXPECT_LT(std::abs(e.mean - expected), limit * e.standard_error + 1e-5);
    EXPECT_LT(limit * e.standard_error, 0.03 * expected);
  }
}

/// The Cornell box with one of its blocks of glass: light reaches its shadow through it alone.
TEST(Glass, EstimatorsAgreeThroughGlass) {
  Scene scene = test::own_scene("cornell-box", 24, 24);
  const auto block = static_cast<std::uint32_t>(scene.materials.size());
  for (std::size_t t = scene.triangles.size() - 10; t < scene.triangles.size(); ++t) {
    if (scene.facets[t].emitter == kNoEmitter) scene.facets[t].material = block;
  }
  scene.glass.assign(scene.materials.size(), Dielectric{});
  scene.materials.push_back(make_material({}, {}, 1));
  scene.glass.push_back({1.5f, {0.8f, 1, 0.95f}});
  scene.needs.model.glass = true;
  std::vector<Estimate> estimates;
  std::uint64_t seed = 0;
  for (const auto& [integrator, lights, spp] :
       {std::tuple("mis", "power", 64u), std::tuple("mis", "tree", 64u), std::tuple("direct", "power", 64u),
        std::tuple("brdf", "power", 256u), std::tuple("mis-report", "power", 128u)}) {
    estimates.push_back(test::mean_over_seeds(scene, {"embree", integrator, lights}, spp, seed, kSeeds));
    seed += kSeeds;
    std::printf("%-10s %-6s %.5f +- %.5f\n", integrator, lights, estimates.back().mean,
                estimates.back().standard_error);
  }
  const double limit = test::t_limit(kFalseAlarm, static_cast<int>(estimates.size()) - 1, kSeeds - 1);
  for (const Estimate& e : estimates) {
    EXPECT_LT(std::abs(test::z_score(e, estimates.front())), limit);
    EXPECT_LT(limit * e.standard_error / e.mean, 0.05);
  }
}

}  // namespace
}  // namespace lemma
