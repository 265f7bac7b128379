#include <limits>

#include "integrators/emission.h"
#include "integrators/observed.h"
#include "integrators/path_end.h"

namespace lemma {
namespace {

/// The estimator of the report's eq. (11) as it is written: at every vertex a light sample and a BRDF sample,
/// both weighted, both of the whole radiance that arrives from their direction, be it emitted or reflected. A
/// light sample whose light is hidden so counts what hides it. Two things differ from the report's program:
///
/// It went on with both directions, 2 x 0.6 = 1.2 new paths a vertex, which in a closed scene never end. Here
/// what is emitted counts from both, but what is reflected is estimated for one of the two, chosen in
/// proportion to the throughputs and divided by the probability: one path, the same mean.
///
/// Its weights summed to more than 1 where a direction meets two lights. Here the light technique is: choose
/// a point on an emitter; it counts only if no other emitter lies before it, whatever else does. The density
/// of a direction is then that of the first emitter along it, through all that is in between.
template <Model M>
class ReportIntegrator final : public ObservedIntegrator<ReportIntegrator<M>> {
 public:
  explicit ReportIntegrator(const IntegratorOptions& options) : options_(options) {}

  template <class Observer>
  Rgb follow(const Ray& camera_ray, const std::optional<Hit>& first, const World& world, Tracer& tracer,
             Sampler& random, Observer& observer) const {
    Rgb radiance, throughput{1, 1, 1};
    Ray ray = camera_ray;
    std::optional<Hit> hit = seen(world.scene, ray, first);
    if (!hit) observer.end(PathEnd::escaped);
    if (hit && emitter_at(world.scene, *hit) != nullptr) {
      radiance = emitted(*emitter_at(world.scene, *hit), ray.origin);
      observer.emitter(*hit, radiance, PdfSolidAngle{0}, 1.0f, radiance);
      if (!options_.emitters_reflect) return radiance;
    }
    for (int depth = 1; hit; ++depth) {
      if (is_cut(options_, depth, tracer, observer)) break;
      const Vertex<M> vertex(world.scene, ray, *hit);
      observer.surface(*hit, vertex, throughput);
      LightQuery& query = tracer.light_query;
      look_from(vertex, world, query);
      const Branch light = follow_light(world, vertex, query, throughput, tracer, random, observer);
      const Branch brdf = follow_brdf(world, vertex, query, throughput, tracer, random, observer);
      radiance += light.contribution;
      radiance += brdf.contribution;

      const float a = max_channel(light.throughput), b = max_channel(brdf.throughput);
      if (a + b == 0) {
        observer.end(PathEnd::done);
        break;
      }
      const bool with_light = b == 0 || (a > 0 && random.next() * (a + b) < a);
      const Branch& next = with_light ? light : brdf;
      observer.choice(with_light, (with_light ? a : b) / (a + b));
      throughput = next.throughput * ((a + b) / (with_light ? a : b));
      if (!survives_roulette(options_, depth, throughput, random, observer)) break;
      ray = next.ray;
      hit = next.hit;
    }
    return radiance;
  }

 private:
  /// What one direction brings and where the path could go on.
  struct Branch {
    Rgb contribution{};  // what is emitted there
    Rgb throughput{};    // of what is reflected there; black if nothing is
    Ray ray{};
    Hit hit{};
  };

  /// What a ray sees of what it hits.
  static std::optional<Hit> seen(const Scene& scene, const Ray& ray, const std::optional<Hit>& hit) {
    return M.overlays && hit ? top_of(scene, ray, *hit) : hit;
  }

  /// The first hit along the ray, from `hit` on, with an emitter that sends light to the ray's origin.
  static std::optional<Hit> first_emitter(const Scene& scene, Tracer& tracer, Ray ray,
                                          std::optional<Hit> hit) {
    while (hit) {
      const Emitter* emitter = emitter_at(scene, *hit);
      if (emitter != nullptr && emits_towards(*emitter, ray.origin)) return hit;
      // A step beyond rounding, so that it ends. What lies within the step is skipped for sampling and
      // density.
      ray.t_min = std::max({ray.t_min, hit->t, std::numeric_limits<float>::min()}) * (1 + 0x1p-20f);
      hit = seen(scene, ray, tracer.closest_hit(ray));
    }
    return std::nullopt;
  }

  /// How far along the ray of a light sample, which meets `hit` first, the light is, or what lies before it
  /// by a rounding; nothing if another emitter comes first.
  static std::optional<float> distance_of_light(const World& world, const Ray& ray,
                                                const std::optional<Hit>& hit, Tracer& tracer,
                                                LightSample& light) {
    if (light.whole != nullptr) {
      const auto first = first_emitter(world.scene, tracer, ray, hit);
      return first && meets(world, *first, ray.origin, light) ? std::optional(first->t) : std::nullopt;
    }
    const Ray to_light{ray.origin, light.to_light, 0, light.visible_until};
    if (M.overlays && is_covered(world.scene, to_light, light.emitter)) return std::nullopt;
    const float until = light.visible_until * length(light.to_light);
    if (!hit || hit->t >= until) return until;
    const auto before = first_emitter(world.scene, tracer, {ray.origin, ray.direction, 0, until}, hit);
    return before && before->t < until ? std::nullopt : std::optional(until);
  }

  template <class Observer>
  Branch follow_light(const World& world, const Vertex<M>& vertex, const LightQuery& query,
                      const Rgb& throughput, Tracer& tracer, Sampler& random, Observer& observer) const {
    std::optional<LightSample> light = world.lights.sample(query, random);
    const auto lost = [&](LightFate fate) {
      observer.light(vertex, light, fate, 0.0f, Rgb{});
      return Branch{};
    };
    if (!light) return lost(LightFate::none);
    const auto [f_cos, pdf_brdf] = vertex.at(light->wi);
    if (is_black(f_cos)) return lost(LightFate::below);
    const Ray ray{vertex.origin(), light->wi};
    const std::optional<Hit> hit = seen(world.scene, ray, tracer.closest_hit(ray));
    const std::optional<float> until = distance_of_light(world, ray, hit, tracer, *light);
    if (!until) return lost(light->whole != nullptr ? LightFate::missed : LightFate::covered);
    const bool hidden = hit && hit->t < *until;
    const float weight = mis_weight(options_.heuristic, light->pdf, pdf_brdf);
    const Rgb reflected = throughput * (f_cos * (weight / light->pdf.value));
    Branch branch{.ray = ray};
    if (!hidden) branch.contribution = reflected * light->radiance;
    observer.light(vertex, light, hidden ? LightFate::hidden : LightFate::seen, weight, branch.contribution);
    // A ray to a seen light that slips past it, by rounding, has met nothing that reflects.
    const bool meets_emitter = hit && emitter_at(world.scene, *hit) != nullptr;
    if (meets_emitter ? options_.emitters_reflect : hidden) {
      branch.throughput = reflected;
      branch.hit = *hit;
    }
    return branch;
  }

  template <class Observer>
  Branch follow_brdf(const World& world, const Vertex<M>& vertex, const LightQuery& query,
                     const Rgb& throughput, Tracer& tracer, Sampler& random, Observer& observer) const {
    const std::optional<ScatterSample> next = vertex.sample(random);
    observer.scatter(next);
    if (!next) return {};
    const Ray ray{next->origin, next->wi};
    const std::optional<Hit> hit = seen(world.scene, ray, tracer.closest_hit(ray));
    if (!hit) return {};
    const auto first = first_emitter(world.scene, tracer, ray, hit);
    const PdfSolidAngle pdf_light = first ? light_pdf(world, query, *first) : PdfSolidAngle{0};
    const float weight = mis_weight(options_.heuristic, next->pdf, pdf_light);
    const Rgb reflected = throughput * next->weight * weight;
    Branch branch{.ray = ray, .hit = *hit};
    const Emitter* emitter = emitter_at(world.scene, *hit);
    if (emitter != nullptr) {
      const Rgb emission = emitted(*emitter, ray.origin);
      branch.contribution = reflected * emission;
      observer.emitter(*hit, emission, next->pdf, weight, branch.contribution);
    }
    if (emitter == nullptr || options_.emitters_reflect) branch.throughput = reflected;
    return branch;
  }

  IntegratorOptions options_;
};

}  // namespace

std::unique_ptr<const Integrator> make_mis_report(const Model& model, const IntegratorOptions& options) {
  return for_model<ReportIntegrator>(model, options);
}

}  // namespace lemma
