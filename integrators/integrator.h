#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "integrators/mis_options.h"
#include "integrators/roulette.h"
#include "integrators/tracer.h"
#include "src/core/named.h"
#include "src/core/sampler.h"
#include "src/lights/light_sampler.h"
#include "src/scene/scene.h"

namespace lemma {

class PathRecorder;

/// All that light transport reads; it never changes while rendering.
struct World {
  const Scene& scene;
  const Accelerator& accel;
  const LightSampler& lights;
};

/// Does for waves of camera rays what an Integrator does for single ones; one a thread, for its memory.
class WaveIntegrator {
 public:
  WaveIntegrator() = default;
  WaveIntegrator(const WaveIntegrator&) = delete;
  WaveIntegrator& operator=(const WaveIntegrator&) = delete;
  virtual ~WaveIntegrator() = default;

  /// Integrator::radiance() of the first `count` lanes.
  /// @param random  the numbers of each lane's sample
  virtual void radiances(const RayWave& rays, const HitWave& first, std::size_t count, Tracer& tracer,
                         const SamplerWave& random, RgbWave& radiance) = 0;
};

/// Estimates the radiance along a camera ray. Paths end at emitters, which do not reflect (the report's
/// rule), unless options say otherwise.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Unbiased estimate of the radiance [W m^-2 sr^-1] that arrives at ray.origin against ray.direction.
  /// @param ray     unit direction
  /// @param first   what the ray hits
  /// @param tracer  counts the rays; one a thread
  /// @param random  the numbers of this sample
  [[nodiscard]] virtual Rgb radiance(const Ray& ray, const std::optional<Hit>& first, const World& world,
                                     Tracer& tracer, Sampler& random) const = 0;

  /// The same, bit for bit, for waves: path by path, by default.
  /// @return who keeps references to the integrator and the world
  [[nodiscard]] virtual std::unique_ptr<WaveIntegrator> waves(const World& world) const;

  /// The same, bit for bit, while the recorder is told all that happens on the path: nothing, by default.
  [[nodiscard]] virtual Rgb explain(const Ray& ray, const std::optional<Hit>& first, const World& world,
                                    Tracer& tracer, Sampler& random, PathRecorder&) const {
    return radiance(ray, first, world, tracer, random);
  }
};

struct IntegratorOptions {
  Roulette roulette = Roulette::throughput;
  Heuristic heuristic = Heuristic::power;                 // of `mis`
  CountedSamples counted_samples = CountedSamples::both;  // by `mis`
  int max_depth = kLastResortDepth;  // scattering events on a path at most: 1 is direct light
  bool emitters_reflect = false;     // emitters also reflect, as their materials say

  /// Deep enough that cutting there is no matter of choice but of ending at all: a closed box of albedo 1.
  static constexpr int kLastResortDepth = 1000;
};

using IntegratorFactory = std::unique_ptr<const Integrator> (*)(const Model&, const IntegratorOptions&);

/// All integrators by the name users give them.
[[nodiscard]] std::span<const Named<IntegratorFactory>> integrators();

/// The integrator Estimator<M> for the parts of the model that a scene needs: they are constants of its code.
/// Every part would double the variants; so textures and glass are one, which has the specular lobe too, and
/// what of it the scene lacks is found out at each vertex. 12 variants are left.
/// Decides one after the other, from the last on: overlays, textures or glass, smooth normals, specular.
template <template <Model> class Estimator, bool... Decided>
[[nodiscard]] std::unique_ptr<const Integrator> for_model(const Model& needed,
                                                          const IntegratorOptions& options) {
  constexpr std::size_t parts = 4;
  constexpr std::array<bool, parts> decided{Decided...};  // the last ones, in the order of Model
  if constexpr (sizeof...(Decided) == parts) {
    constexpr Model model{.specular = decided[0],
                          .smooth_normals = decided[1],
                          .textures = decided[2],
                          .glass = decided[2],
                          .overlays = decided[3]};
    return std::make_unique<Estimator<model>>(options);
  } else if constexpr (sizeof...(Decided) + 1 == parts && decided[1]) {
    return for_model<Estimator, true, Decided...>(needed, options);
  } else {
    const std::array<bool, parts> parts_needed{needed.overlays, needed.textures || needed.glass,
                                               needed.smooth_normals, needed.specular};
    return parts_needed[sizeof...(Decided)] ? for_model<Estimator, true, Decided...>(needed, options)
                                            : for_model<Estimator, false, Decided...>(needed, options);
  }
}

}  // namespace lemma
