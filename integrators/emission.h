#pragma once

#include "integrators/integrator.h"

namespace lemma {

/// The emitter that a hit lies on, or null.
[[nodiscard]] inline const Emitter* emitter_at(const Scene& scene, const Hit& hit) {
  const std::uint32_t index = scene.facets[hit.triangle].emitter;
  return index == kNoEmitter ? nullptr : &scene.emitters[index];
}

/// Radiance that an emitter sends towards x.
[[nodiscard]] inline Rgb emitted(const Emitter& emitter, const Vec3& x) {
  return emits_towards(emitter, x) ? emitter.radiance : Rgb{};
}

/// The density with which light sampling at `from` would have chosen the direction of this hit.
[[nodiscard]] inline PdfSolidAngle light_pdf(const World& world, const LightQuery& from, const Hit& hit) {
  const Vec3 y(point_at(world.scene.triangles[hit.triangle], hit.b1, hit.b2));
  return world.lights.pdf(from, world.scene.facets[hit.triangle].emitter, y);
}

/// One light sample at a vertex: f cos L / pdf times the Technique's weight (path.h); 0 if the light is not
/// seen.
template <class Technique, class Vertex>
[[nodiscard]] Rgb light_sample(const World& world, const Vertex& vertex, const LightQuery& query,
                               Tracer& tracer, Sampler& random) {
  const std::optional<LightSample> light = world.lights.sample(query, random);
  if (!light) return {};
  const Rgb f_cos = vertex.eval_cos(light->wi);
  if (is_black(f_cos)) return {};
  if (tracer.occluded({vertex.origin(), light->to_light, 0, light->visible_until})) return {};
  return f_cos * light->radiance *
         (Technique::light_weight(light->pdf, vertex.pdf(light->wi)) / light->pdf.value);
}

}  // namespace lemma
