#include <cmath>
#include <numbers>

#include "tests/hard/hard_case.h"
#include "tests/support/images.h"
#include "tests/support/light_scenes.h"
#include "tests/support/lights.h"

namespace lemma::test {
namespace {

constexpr int kSeeds = 32;
// For all estimators of a row.
constexpr double kFalseAlarm = 1e-3;

/// 19: a diffuse floor under a light that it cuts: Lambert's formula for the part above, with each light
/// sampling, at points near the light and far from it. The light is seen by nothing but the floor.
Outcome irradiance_of_a_cut_light(std::string_view backend) {
  constexpr float albedo = 0.5f;
  Scene scene = light_below_horizon(false);
  scene.materials = {make_material({albedo, albedo, albedo}, {}, 1)};
  scene.needs.model.specular = false;
  scene.view.width = scene.view.height = 4;
  scene.view.fovy = 0.01;  // all pixels see one point
  const Vec3 points[] = {{0, 0, 0.1f}, {-0.6f, 0, -0.9f}, {0.5f, 0, -1.1f}, {0.2f, 0, 1.5f}};
  const double limit =
      t_limit(kFalseAlarm, static_cast<int>(std::size(points) * light_samplers().size()), kSeeds - 1);
  Outcome outcome;
  for (const Vec3& point : points) {
    scene.view.look_at = point;
    double expected = 0;
    for (const Emitter& e : scene.emitters) expected += irradiance(e, point, {0, 1, 0});
    expected *= double{albedo} / std::numbers::pi;
    for (const auto& lights : light_samplers()) {
      const Estimate e = mean_over_seeds(scene, {backend, "direct", lights.name}, 64, 0, kSeeds);
      ++outcome.rays;
      outcome.faults += std::abs(e.mean - expected) < limit * e.standard_error + 1e-5 * expected ? 0 : 1;
    }
  }
  return outcome;
}

/// 21: lights that run into each other: the density of the first one seen must do, for all ways to choose
/// lights and to weigh samples. Counting hidden ones or forgetting some adds or takes up to half.
Outcome weights_of_overlapping_lights(std::string_view backend) {
  const Scene scene = overlapping_lights();
  const Estimate reference = mean_over_seeds(scene, {backend, "brdf", "tree"}, 64, 1000, kSeeds);
  const double limit =
      t_limit(kFalseAlarm, static_cast<int>(light_samplers().size() * (heuristics().size() + 1)), kSeeds - 1);
  Outcome outcome;
  const auto compare = [&](const Configuration& c, std::uint32_t spp) {
    const Estimate e = mean_over_seeds(scene, c, spp, outcome.rays * kSeeds, kSeeds);
    ++outcome.rays;
    outcome.faults += std::abs(z_score(e, reference)) < limit ? 0 : 1;
  };
  for (const auto& lights : light_samplers()) {
    for (const auto& heuristic : heuristics()) {
      IntegratorOptions options;
      options.heuristic = heuristic.value;
      compare({backend, "mis", lights.name, options}, 4);
    }
    compare({backend, "direct", lights.name}, 8);
  }
  return outcome;
}

}  // namespace

std::span<const HardCase> transport_cases() {
  static constexpr HardCase cases[] = {
      {"19 light cut by the floor", "Lambert's formula", irradiance_of_a_cut_light, true},
      {"21 weights where lights overlap", "equal means", weights_of_overlapping_lights, true}};
  return cases;
}

}  // namespace lemma::test
