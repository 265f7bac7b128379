#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/measure/error_figures.h"
#include "src/measure/estimated_error.h"
#include "src/measure/stop_rule.h"
#include "tests/support/images.h"

namespace lemma {
namespace {

/// What an estimate of relMSE says on average, in units of what relMSE is: half the relMSE between images of
/// different seeds. One value for each pair of seeds, so that their spread tells the standard error.
test::Estimate estimate_over_truth(const Scene& scene, const RenderSettings& settings, int pairs) {
  std::vector<double> estimated, found;
  for (int i = 0; i < pairs; ++i) {
    RenderSettings s = settings;
    s.seed = static_cast<std::uint64_t>(2 * i);
    const RenderResult a = test::render_scene(scene, {}, s);
    ++s.seed;
    const RenderResult b = test::render_scene(scene, {}, s);
    estimated.push_back(estimated_error(a.image, a.variance).relmse.value);
    found.push_back(error_figures(a.image, b.image).relmse / 2);
  }
  const test::Estimate e = test::estimate(estimated), f = test::estimate(found);
  const double ratio = e.mean / f.mean;
  return {ratio, ratio * std::hypot(e.standard_error / e.mean, f.standard_error / f.mean), pairs};
}

struct Case {
  const char* name;
  RenderSettings settings;
  double most;  // that the estimate may be too large by
};

/// The floor and the wall of the box, without the light: pixels of heavy tails would need too many seeds.
Scene quiet_scene() {
  Scene scene = test::own_scene("cornell-box", 24, 24);
  scene.view.look_at.y -= 0.15f;
  scene.view.fovy /= 2;
  return scene;
}

/// Chance of a false alarm of all together 1e-3. An estimate of relMSE divides by the square of the same
/// noisy image, which makes it a few percent wrong at these errors: 5 % are allowed for.
TEST(Variance, EstimatesAreHonest) {
  const std::vector<Case> cases = {
      {"independent", {.spp = 32, .sequence = Sequence::independent}, 1.05},
      {"independent, 27 samples", {.spp = 27, .sequence = Sequence::independent}, 1.05},
      {"sobol, 2 replicates", {.spp = 64, .replicates = 2}, 1.05},
      {"sobol, 4 replicates", {.spp = 64, .replicates = 4}, 1.05},
      // Halves of one sequence: 2^a - 1 times with the rate a between 1 and 2.
      {"sobol", {.spp = 64}, 3},
      {"sobol, 48 samples", {.spp = 48}, 3},
  };
  constexpr int kPairs = 16;
  const double limit = test::t_limit(1e-3, 2 * static_cast<int>(cases.size()), kPairs - 1);
  const Scene scene = quiet_scene();
  for (const Case& c : cases) {
    const test::Estimate ratio = estimate_over_truth(scene, c.settings, kPairs);
    std::printf("%-24s estimated / true relMSE %.3f +- %.3f\n", c.name, ratio.mean, ratio.standard_error);
    EXPECT_GT(ratio.mean + limit * ratio.standard_error, 0.95) << c.name;
    EXPECT_LT(ratio.mean - limit * ratio.standard_error, c.most) << c.name;
    EXPECT_LT(limit * ratio.standard_error, 0.25) << c.name << ": too noisy to show anything";
  }
}

/// Stopping when the estimated error is small enough favours images that look calm: how much darker are they?
/// Bounds what the README states.
TEST(Variance, StoppingAtAnErrorHardlyBiasesTheImage) {
  const Scene scene = quiet_scene();
  const auto accel = find_named(accelerators(), "embree").value()(scene.triangles, {});
  const auto lights = light_samplers().front().value(scene.emitters, scene.triangles);
  const auto integrator = integrators().front().value(scene.needs.model, {});
  std::vector<double> stopped, whole;
  const StopRule rule{.spp = 4096, .relmse = 0.005};
  constexpr int kSeeds = 60;
  for (int i = 0; i < kSeeds; ++i) {
    RenderSettings settings{.spp = 64, .seed = static_cast<std::uint64_t>(1000 + i)};
    Rendering rendering({scene, *accel, *lights}, *integrator, settings);
    PassState state;
    for (std::uint32_t next = next_spp(rule, state); next > state.spp; next = next_spp(rule, state)) {
      rendering.render_to(next, nullptr);
      const RenderResult r = rendering.result();
      state = {next, 0, estimated_error(r.image, r.variance).relmse.value};
    }
    stopped.push_back(test::image_mean(rendering.result().image));
    settings.seed += kSeeds;
    settings.spp = 256;
    whole.push_back(test::image_mean(test::render_scene(scene, {}, settings).image));
  }
  const test::Estimate a = test::estimate(stopped), b = test::estimate(whole);
  const double bias = a.mean / b.mean - 1, error = std::hypot(a.standard_error, b.standard_error) / b.mean;
  std::printf("bias of the image mean by stopping: %+.5f +- %.5f\n", bias, error);
  EXPECT_LT(std::abs(bias), 0.002 + test::z_limit(1e-3, 1) * error);
  EXPECT_LT(error, 0.001) << "too noisy to show anything";
}

}  // namespace
}  // namespace lemma
