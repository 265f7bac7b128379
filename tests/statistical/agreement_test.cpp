#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/agreement.h"
#include "tests/support/images.h"
#include "tests/support/light_scenes.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using test::Estimate;
using test::expect_agreement;
using test::kFalseAlarm;

constexpr int kScenes = 7;

Scene small_scene(std::string_view name, const Vec3& eye, const Vec3& look_at, float fovy) {
  Scene scene = test::own_scene(name, 8, 8);
  scene.view.eye = eye;
  scene.view.look_at = look_at;
  scene.view.fovy = fovy;
  return scene;
}

Scene smaller(Scene scene) {
  scene.view.width = scene.view.height = 8;
  return scene;
}

/// From below the ceiling on the tall block and what is around it. Pixels that hold a part of a light would
/// have a noise of their own, the same for all; and the light is larger from the block than from the floor.
Scene cornell(std::string_view name) {
  return small_scene(name, {278, 480, -150}, {330, 320, 330}, 40);
}

/// The plates and the floor alone.
TEST(Agreement, VeachScene) {
  Scene scene = test::own_scene("veach-mis", 8, 8);
  scene.view.look_at = {5, 1.5f, 0};
  scene.view.fovy = 10;
  expect_agreement({.scene = scene}, kScenes);
}

TEST(Agreement, CornellBox) {
  expect_agreement({.scene = cornell("cornell-box")}, kScenes);
}

TEST(Agreement, CornellBoxWithTheLightInTheCeiling) {
  expect_agreement({.scene = cornell("cornell-coplanar")}, kScenes);
}

TEST(Agreement, ManyLights) {
  expect_agreement({.scene = smaller(test::many_lights())}, kScenes);
}

TEST(Agreement, OverlappingLights) {
  expect_agreement({.scene = smaller(test::overlapping_lights())}, kScenes);
}

/// The floor and the block alone: the light itself would be most of the mean.
TEST(Agreement, LightPartlyBelowTheHorizon) {
  Scene scene = smaller(test::light_below_horizon());
  scene.view.look_at = {0, 0, 0.3f};
  scene.view.fovy = 15;
  expect_agreement({.scene = scene, .touches_light = true}, kScenes);
}

/// A light that lies twice in one place: seen once, whatever finds it (src/scene/overlays.h).
TEST(Agreement, LightsOnTopOfEachOther) {
  Scene scene = cornell("cornell-coplanar");
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
  expect_agreement({.scene = scene}, kScenes);
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
  constexpr int seeds = 32;
  struct Case {
    float albedo;
    Roulette roulette;
    const char *integrator, *lights;
  };
  std::vector<Case> cases;
  for (const char* lights : {"tree", "power", "radiance-area", "solid-angle", "projected"}) {
    for (const auto& roulette : roulettes()) cases.push_back({0.5f, roulette.value, "mis", lights});
    cases.push_back({0.9f, Roulette::throughput, "mis", lights});
  }
  cases.push_back({0.5f, Roulette::throughput, "brdf", "power"});
  cases.push_back({0.5f, Roulette::throughput, "direct", "solid-angle"});
  cases.push_back({0.9f, Roulette::throughput, "brdf", "power"});
  for (const auto& roulette : roulettes()) cases.push_back({0.5f, roulette.value, "mis-report", "tree"});
  cases.push_back({0.9f, Roulette::throughput, "mis-report", "tree"});
  const double limit = test::t_limit(kFalseAlarm, static_cast<int>(cases.size()), seeds - 1);
  for (const Case& c : cases) {
    IntegratorOptions options;
    options.roulette = c.roulette;
    options.emitters_reflect = true;
    const Estimate e =
        test::mean_over_seeds(furnace(c.albedo), {"grid", c.integrator, c.lights, options}, 128, 0, seeds);
    const double expected = 1 / (1 - double{c.albedo});
    std::printf("%-6s %-13s albedo %.1f: %.5f +- %.5f\n", c.integrator, c.lights, double{c.albedo}, e.mean,
                e.standard_error);
    EXPECT_LT(std::abs(e.mean - expected), limit * e.standard_error + 1e-6 * expected);
    EXPECT_LT(limit * e.standard_error, 0.02 * expected);
  }
}

}  // namespace
}  // namespace lemma
