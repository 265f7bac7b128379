#pragma once

#include "integrators/emission.h"
#include "integrators/observed.h"
#include "integrators/path_end.h"
#include "integrators/path_wave.h"
#include "integrators/vertex.h"

namespace lemma {

/// A path from the camera that goes on by BRDF samples. Emitted light is found in two ways, by the direction
/// the path goes on with and by a light sample at each vertex; a Technique says with which weights they
/// count. The estimate is unbiased if the two weights of every direction sum to 1. A Technique is made from
/// IntegratorOptions and has
///   kSamplesLights                   whether light samples are taken at all
///   light_weight(light, brdf)        of a light sample, given both densities of its direction
///   brdf_weight(brdf, light)         of an emitter met at depth > 1; light() gives the density of light
///   sampling
///   weighting()                      these weights by name
template <Model M, class Technique>
class PathIntegrator final : public ObservedIntegrator<PathIntegrator<M, Technique>> {
 public:
  explicit PathIntegrator(const IntegratorOptions& options) : options_(options), technique_(options) {}

  template <class Observer>
  Rgb follow(const Ray& camera_ray, const std::optional<Hit>& first, const World& world, Tracer& tracer,
             Sampler& random, Observer& observer) const {
    Rgb radiance, throughput{1, 1, 1};
    Ray ray = camera_ray;
    std::optional<Hit> hit = first;
    LightQuery& query = tracer.light_query;  // of the vertex that the ray left ...
    PdfSolidAngle pdf_brdf;                  // ... in a direction of this density
    for (int depth = 1; hit; ++depth) {
      if constexpr (M.overlays) hit = top_of(world.scene, ray, *hit);
      if (const Emitter* emitter = emitter_at(world.scene, *hit)) {
        // No light sample could have found what the camera sees, directly or through glass.
        const bool only_path = depth == 1 || (M.glass && std::isinf(pdf_brdf.value));
        const float weight =
            only_path ? 1.0f
                      : technique_.brdf_weight(pdf_brdf, [&] { return light_pdf(world, query, *hit); });
        const Rgb emission = emitted(*emitter, ray.origin), contribution = throughput * emission * weight;
        observer.emitter(*hit, emission, pdf_brdf, weight, contribution);
        radiance += contribution;
        if (!options_.emitters_reflect) break;
      }
      if (is_cut(options_, depth, tracer, observer)) break;
      const Vertex<M> vertex(world.scene, ray, *hit);
      observer.surface(*hit, vertex, throughput);
      if constexpr (Technique::kSamplesLights) {
        if (!vertex.is_glass()) {
          look_from(vertex, world, query);
          radiance += light_sample<M>(world, technique_, vertex, query, throughput, tracer, random, observer);
        }
      }
      const std::optional<ScatterSample> next = vertex.sample(random);
      observer.scatter(next);
      if (!next) break;
      throughput *= next->weight;
      if (!survives_roulette(options_, depth, throughput, random, observer)) break;
      ray = {next->origin, next->wi};
      pdf_brdf = next->pdf;
      hit = tracer.closest_hit(ray);
    }
    if (!hit) observer.end(PathEnd::escaped);
    return radiance;
  }

  std::unique_ptr<WaveIntegrator> waves(const World& world) const override {
    return std::make_unique<PathWave>(WaveTechnique{options_, technique_.weighting(), M}, world);
  }

 private:
  IntegratorOptions options_;
  Technique technique_;
};

}  // namespace lemma
