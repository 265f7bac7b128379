#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using test::Configuration;
using test::Estimate;

struct Run {
  Configuration configuration;
  std::uint32_t spp;
  double detectable = 0.03;  // part of the mean that a bias must reach at most to be seen
};

/// Chance that one of the comparisons of a test fails although all estimators have the same mean. Seeds are
/// fixed, so a test that passes does so always; this is the chance of having to look at one after a change
/// that is right.
constexpr double kFalseAlarm = 1e-3;
constexpr int kSeeds = 32;

/// Every run's image mean against the first's, by Welch's t with the fewest degrees of freedom it can have.
void expect_equal_means(const Scene& scene, const std::vector<Run>& runs) {
  const double limit = test::t_limit(kFalseAlarm, static_cast<int>(runs.size()) - 1, kSeeds - 1);
  Estimate reference;
  std::uint64_t first_seed = 0;  // each run has seeds of its own: their errors are independent
  for (const Run& run : runs) {
    const Estimate e = test::mean_over_seeds(scene, run.configuration, run.spp, first_seed, kSeeds);
    first_seed += kSeeds;
    if (&run == &runs.front()) reference = e;
    const double z = &run == &runs.front() ? 0 : test::z_score(e, reference);
    std::printf("%-6s %-6s %-13s %-10s mean %.6f +- %.6f  z %5.2f\n", run.configuration.accel.data(),
                run.configuration.integrator.data(), run.configuration.lights.data(),
                run.configuration.options.roulette == Roulette::fixed ? "fixed" : "throughput", e.mean,
                e.standard_error, z);
    EXPECT_LT(std::abs(z), limit);
    // What a comparison cannot see must be small, or it shows nothing.
    EXPECT_LT(limit * e.standard_error / e.mean, run.detectable) << "this run is too noisy to detect a bias";
  }
}

/// All integrators with all light samplings, each roulette and the other accelerator. Samples a pixel are
/// such that the standard errors are about equal: light samples alone do badly on sharp plates, `solid-angle`
/// is slow but precise.
std::vector<Run> all_estimators(std::uint32_t spp) {
  IntegratorOptions fixed;
  fixed.roulette = Roulette::fixed;
  IntegratorOptions squared;
  squared.heuristic = Heuristic::power;
  return {
      {{"embree", "mis", "power"}, 4 * spp},
      {{"grid", "mis", "power"}, spp},
      {{"embree", "mis", "power", fixed}, 4 * spp},
      {{"embree", "mis", "power", squared}, 4 * spp},
      {{"embree", "mis", "radiance-area"}, 4 * spp},
      {{"embree", "mis", "solid-angle"}, spp},
      {{"embree", "mis", "tree"}, spp},
      {{"embree", "mis", "tree", {}, Sequence::independent}, spp},
      {{"embree", "mis", "tree", squared}, spp},
      {{"embree", "direct", "tree"}, 3 * spp},
      {{"embree", "direct", "power"}, 32 * spp},
      {{"embree", "direct", "power", fixed}, 32 * spp},
      {{"embree", "direct", "solid-angle"}, 3 * spp},
      {{"embree", "brdf", "power"}, 16 * spp},
      {{"embree", "mis-report", "tree"}, spp},
      {{"embree", "mis-report", "power", squared}, 4 * spp},
  };
}

/// The report's choice of lights by radiance alone sends four samples of five to the smallest one: with light
/// samples alone its error is several times that of the others.
TEST(Agreement, VeachScene) {
  Scene scene = test::own_scene("veach-mis", 48, 27);
  // The plates and the floor alone: pixels that hold a part of a light have a noise of their own, the same
  // for all.
  scene.view.look_at = {5, 1.5f, 0};
  scene.view.fovy = 10;
  auto runs = all_estimators(8);
  runs.push_back({{"embree", "direct", "radiance-area"}, 256, 0.1});
  expect_equal_means(scene, runs);
}

TEST(Agreement, CornellBox) {
  auto runs = all_estimators(12);
  runs.push_back({{"embree", "direct", "radiance-area"}, 256});
  expect_equal_means(test::own_scene("cornell-box", 32, 32), runs);
}

TEST(Agreement, CornellBoxWithTheLightInTheCeiling) {
  expect_equal_means(test::own_scene("cornell-coplanar", 32, 32), all_estimators(12));
}

/// A light that lies twice in one place: seen once, whatever finds it (src/scene/overlays.h).
TEST(Agreement, LightsOnTopOfEachOther) {
  Scene scene = test::own_scene("cornell-coplanar", 32, 32);
  for (const Emitter& e : std::vector(scene.emitters)) {
    Emitter copy = e;
    copy.triangle = static_cast<std::uint32_t>(scene.triangles.size());
    copy.radiance = e.radiance * 3;
    copy.light = 1;
    scene.triangles.push_back(e.shape);
    scene.facets.push_back(
        {scene.facets[e.triangle].material, static_cast<std::uint32_t>(scene.emitters.size())});
    scene.emitters.push_back(copy);
  }
  scene.overlays = find_overlays(scene.triangles, scene.emitters);
  expect_equal_means(scene, all_estimators(12));
}

/// A closed box that emits 1 and reflects half of what arrives: radiance 1 / (1 - 0.5) = 2 everywhere.
Scene furnace(float albedo) {
  Scene scene;
  scene.view = {{0.2f, 0.3f, 0.4f}, {0.9f, 0.6f, 0.5f}, {0, 1, 0}, 60, 8, 8};
  scene.triangles = test::inward_box({-1, -1, -1}, {1, 1, 2});
  scene.materials = {make_material({albedo, albedo, albedo}, {}, 1)};
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    scene.facets.push_back({0, i});
    scene.emitters.push_back({scene.triangles[i], {1, 1, 1}, i, 0});
  }
  scene.needs.lights = 1;
  scene.needs.emitter_triangles = scene.emitters.size();
  return scene;
}

/// `direct` is left to solid-angle: by area, light samples have infinite variance at the edges where two
/// emitting walls meet, since 1 / distance^2 has no bound there. Roulette `fixed` is left out at albedo 0.9,
/// beyond sqrt(0.6).
TEST(Furnace, ClosedBoxHasTheGeometricSeries) {
  struct Case {
    float albedo;
    Roulette roulette;
    const char *integrator, *lights;
  };
  std::vector<Case> cases;
  for (const char* lights : {"tree", "power", "radiance-area", "solid-angle"}) {
    for (const auto& roulette : roulettes()) cases.push_back({0.5f, roulette.value, "mis", lights});
    cases.push_back({0.9f, Roulette::throughput, "mis", lights});
  }
  cases.push_back({0.5f, Roulette::throughput, "brdf", "power"});
  cases.push_back({0.5f, Roulette::throughput, "direct", "solid-angle"});
  cases.push_back({0.9f, Roulette::throughput, "brdf", "power"});
  for (const auto& roulette : roulettes()) cases.push_back({0.5f, roulette.value, "mis-report", "tree"});
  cases.push_back({0.9f, Roulette::throughput, "mis-report", "tree"});
  const double limit = test::t_limit(kFalseAlarm, static_cast<int>(cases.size()), kSeeds - 1);
  for (const Case& c : cases) {
    IntegratorOptions options;
    options.roulette = c.roulette;
    options.emitters_reflect = true;
    const Estimate e =
        test::mean_over_seeds(furnace(c.albedo), {"grid", c.integrator, c.lights, options}, 128, 0, kSeeds);
    const double expected = 1 / (1 - double{c.albedo});
    std::printf("%-6s %-13s albedo %.1f: %.5f +- %.5f\n", c.integrator, c.lights, double{c.albedo}, e.mean,
                e.standard_error);
    EXPECT_LT(std::abs(e.mean - expected), limit * e.standard_error + 1e-6 * expected);
    EXPECT_LT(limit * e.standard_error, 0.02 * expected);
  }
}

}  // namespace
}  // namespace lemma
