#pragma once

#include "accel/watertight.h"
#include "integrators/integrator.h"
#include "integrators/path_record.h"
#include "integrators/vertex.h"

namespace lemma {

/// What a ray that hits a triangle sees there: the triangle, or the first emitter on top of it
/// (src/scene/overlays.h).
[[nodiscard]] inline Hit top_of(const Scene& scene, const Ray& ray, const Hit& hit) {
  const auto on_top = scene.overlays.on(hit.triangle);
  if (on_top.empty()) return hit;
  const ShearedRay sheared(Ray{ray.origin, ray.direction});
  for (const std::uint32_t emitter : on_top) {
    const std::uint32_t triangle = scene.emitters[emitter].triangle;
    Hit seen = no_hit(sheared);
    if (intersect(sheared, scene.triangles[triangle], triangle, seen)) return seen;
  }
  return hit;
}

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

// `inline` below tells GCC to inline templates of this size, which it does not by itself.

/// Looks for lights from a vertex.
template <Model M>
inline void look_from(const Vertex<M>& vertex, const World& world, LightQuery& at) {
  world.lights.look_from(vertex.origin(), vertex.shading_normal(), vertex.reflection(), at);
}

/// Whether the ray to a point of an emitter meets another emitter on top of it there.
[[nodiscard]] inline bool is_covered(const Scene& scene, const Ray& to_light, std::uint32_t emitter) {
  const std::uint32_t triangle = scene.emitters[emitter].triangle;
  return top_of(scene, to_light, {1, triangle, 0, 0}).triangle != triangle;
}

/// Whether what a ray from x hits is an emitter of the whole light that emits towards x.
[[nodiscard]] inline bool is_of(const World& world, const WholeLight* whole, const Hit& hit, const Vec3& x) {
  const std::uint32_t emitter = world.scene.facets[hit.triangle].emitter;
  if (emitter == kNoEmitter || world.lights.whole_of(emitter) != whole) return false;
  return emits_towards(world.scene.emitters[emitter], x);
}

/// Whether a hit of the ray from x of a whole light's sample is on that light; then it names the emitter.
[[nodiscard]] inline bool meets(const World& world, const Hit& hit, const Vec3& x, LightSample& light) {
  if (!is_of(world, light.whole, hit, x)) return false;
  light.emitter = world.scene.facets[hit.triangle].emitter;
  light.to_light = light.wi * hit.t;
  return true;
}

/// Whether the ray of a light sample may pass by its light, which then must be what it meets first.
[[nodiscard]] inline bool may_pass_by(const WholeLight* whole, float visible_until) {
  return whole != nullptr && std::isinf(visible_until);
}

/// What the direction of a whole light's sample meets: one of the light's emitters, or something else.
template <Model M>
[[nodiscard]] inline LightFate look_at_whole(const World& world, const Vec3& x, Tracer& tracer,
                                             LightSample& light) {
  const Ray ray{x, light.wi};
  std::optional<Hit> hit = tracer.closest_hit(ray);
  if (!hit) return LightFate::missed;
  if constexpr (M.overlays) hit = top_of(world.scene, ray, *hit);
  return meets(world, *hit, x, light) ? LightFate::seen : LightFate::missed;
}

/// What becomes of a light sample from x that is reflected there.
template <Model M>
[[nodiscard]] inline LightFate look_at_light(const World& world, const Vec3& x, Tracer& tracer,
                                             LightSample& light) {
  if (may_pass_by(light.whole, light.visible_until)) return look_at_whole<M>(world, x, tracer, light);
  const Ray to_light{x, light.to_light, 0, light.visible_until};
  if (M.overlays && light.whole == nullptr && is_covered(world.scene, to_light, light.emitter))
    return LightFate::covered;
  return tracer.occluded(to_light) ? LightFate::hidden : LightFate::seen;
}

/// Finds the emitter of a whole light that is seen, where it was not needed for that.
template <Model M>
void name_emitter(const World& world, const Vec3& x, Tracer& tracer, LightSample& light) {
  if (light.emitter == kNoEmitter) static_cast<void>(look_at_whole<M>(world, x, tracer, light));
}

/// One light sample at a vertex: throughput f cos L / pdf times the Technique's weight (path.h); 0 if the
/// light is not seen.
template <Model M, class Technique, class Observer>
[[nodiscard]] Rgb light_sample(const World& world, const Technique& technique, const Vertex<M>& vertex,
                               const LightQuery& query, const Rgb& throughput, Tracer& tracer,
                               Sampler& random, Observer& observer) {
  std::optional<LightSample> light = world.lights.sample(query, random);
  const auto lost = [&](LightFate fate) {
    observer.light(vertex, light, fate, 0.0f, Rgb{});
    return Rgb{};
  };
  if (!light) return lost(LightFate::none);
  const auto [f_cos, pdf_brdf] = vertex.at(light->wi);
  if (is_black(f_cos)) return lost(LightFate::below);
  const LightFate fate = look_at_light<M>(world, vertex.origin(), tracer, *light);
  if (fate != LightFate::seen) return lost(fate);
  if constexpr (Observer::kRecords) name_emitter<M>(world, vertex.origin(), tracer, *light);
  const float weight = technique.light_weight(light->pdf, pdf_brdf);
  const Rgb contribution = throughput * (f_cos * light->radiance * (weight / light->pdf.value));
  observer.light(vertex, light, LightFate::seen, weight, contribution);
  return contribution;
}

}  // namespace lemma
