// Scenes whose radiance is known: each estimator against a closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "tests/support/hemisphere.h"
#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using test::Estimate;

/// Chance that a test fails although all means are as expected. Seeds are fixed: a test that passes does so
/// always.
constexpr double kFalseAlarm = 1e-3;
constexpr int kSeeds = 32;

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
  for (const char* lights : {"tree", "power", "radiance-area", "solid-angle", "projected"}) {
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

/// A plate in a box whose walls emit 1 and absorb: whatever leaves it is its directional albedo.
Scene plate_in_furnace(const Material& material, const Vec3& towards_camera) {
  Scene scene;
  scene.view = {towards_camera * 3.0f, {0, 0, 0}, {0, 0, -1}, 0.05f, 2, 2};
  scene.triangles = test::inward_box({-5, -5, -5}, {5, 5, 5});
  scene.materials = {material};
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    scene.facets.push_back({0, i});
    scene.emitters.push_back({.shape = scene.triangles[i], .radiance = {1, 1, 1}, .triangle = i});
  }
  scene.triangles.push_back({{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}});
  scene.triangles.push_back({{-1, 0, -1}, {1, 0, 1}, {1, 0, -1}});
  scene.facets.resize(scene.triangles.size());
  scene.needs.model.specular = true;
  return scene;
}

/// Every BRDF with every integrator: kd + ks E(theta), E of the Phong lobe with n = 20 and the factor
/// (n + 1) / (2 pi) by quadrature in double, 5 digits.
TEST(Furnace, PlateReflectsItsDirectionalAlbedo) {
  constexpr float n = 20, kd = 0.25f, ks = 0.5f;
  constexpr std::pair<double, double> phong[] = {{0, .95455}, {60, .47776}, {85, .13201}};
  constexpr BrdfOptions brdfs[] = {{.sampling = LobeSampling::truncated},
                                   {.sampling = LobeSampling::p6},
                                   {.norm = PhongNorm::n_plus_2},
                                   {.lobe = Lobe::blinn_phong}};
  const auto cases = std::size(phong) * std::size(brdfs) * integrators().size();
  const double limit = test::t_limit(kFalseAlarm, static_cast<int>(cases), kSeeds - 1);
  for (const auto& [angle, lobe_albedo] : phong) {
    for (const BrdfOptions& brdf : brdfs) {
      const Vec3 local = test::direction(angle, 0), towards_camera(local.x, local.z, local.y);
      const double albedo = brdf.lobe == Lobe::blinn_phong     ? test::blinn_albedo(n, local)
                            : brdf.norm == PhongNorm::n_plus_2 ? lobe_albedo * (n + 2) / (n + 1)
                                                               : lobe_albedo;
      const double expected = kd + ks * albedo;
      const Scene scene =
          plate_in_furnace(make_material({kd, kd, kd}, {ks, ks, ks}, n, brdf), towards_camera);
      for (const auto& integrator : integrators()) {
        const std::uint32_t spp = integrator.name == "direct" ? 50 * 64 : 64;  // for about equal noise
        const Estimate e =
            test::mean_over_seeds(scene, {"grid", integrator.name, "solid-angle"}, spp, 0, kSeeds);
        EXPECT_NEAR(e.mean, expected, limit * e.standard_error + 5e-5)
            << integrator.name << ", " << angle << " degrees, " << name_of(lobes(), brdf.lobe);
        EXPECT_LT(limit * e.standard_error, 0.03 * expected);  // what is not seen
      }
    }
  }
}

}  // namespace
}  // namespace lemma
