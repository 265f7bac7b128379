#include "src/app/accelerator_cost.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "src/render/render.h"

namespace lemma {
namespace {

constexpr double kProbeSamples = 4096;        // of the camera
constexpr std::size_t kMostForBrute = 20000;  // triangles: more take longer than a second

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The scene with an image of about as many pixels as are probed, of the same shape.
Scene probe_of(const Scene& scene) {
  Scene probe = scene;
  const double pixels = double(scene.view.width) * double(scene.view.height);
  const double scale = std::min(1.0, std::sqrt(kProbeSamples / pixels));
  probe.view.width = std::max(1, static_cast<int>(scene.view.width * scale));
  probe.view.height = std::max(1, static_cast<int>(scene.view.height * scale));
  return probe;
}

}  // namespace

std::vector<AcceleratorCost> measure_costs(const Scene& scene) {
  const Scene probe = probe_of(scene);
  const auto lights = light_samplers().front().value(probe.emitters, probe.triangles);
  const auto integrator = integrators().front().value(probe.needs.model, {});
  std::vector<AcceleratorCost> costs;
  for (const Named<AcceleratorFactory>& entry : accelerators()) {
    if (entry.name == "brute" && scene.triangles.size() > kMostForBrute) continue;
    const auto start = std::chrono::steady_clock::now();
    const auto accel = entry.value(probe.triangles, {});
    AcceleratorCost cost{std::string(entry.name), seconds_since(start), accel->memory_bytes()};
    const RenderResult result = render({probe, *accel, *lights}, *integrator, {.spp = 1}, {});
    cost.seconds_a_sample =
        result.seconds / static_cast<double>(std::max<std::uint64_t>(1, result.camera_samples));
    costs.push_back(cost);
  }
  return costs;
}

}  // namespace lemma
