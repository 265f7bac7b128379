#include "integrators/path_recorder.h"

namespace lemma {

void PathRecorder::add_surface(const Hit& hit, const Place& place, const Rgb& throughput) {
  from_ = place;
  events_.emplace_back(
      SurfaceEvent{hit.triangle, scene_.facets[hit.triangle].material, place.x, place.n, throughput});
}

void PathRecorder::add_light(const std::optional<LightSample>& sample, LightEvent event) {
  if (sample) {
    event.wi = sample->wi;
    event.radiance = sample->radiance;
    event.pdf = sample->pdf.value;
    event.emitter = sample->emitter;
    if (sample->emitter != kNoEmitter) {
      event.distance = length(sample->to_light);
      event.densities.light = light_densities(sample->emitter, from_->x + sample->to_light);
    }
  }
  events_.emplace_back(std::move(event));
}

void PathRecorder::scatter(const std::optional<ScatterSample>& next) {
  events_.emplace_back(next ? ScatterEvent{false, next->wi, next->pdf.value, next->weight}
                            : ScatterEvent{.absorbed = true});
}

void PathRecorder::emitter(const Hit& hit, const Rgb& radiance, PdfSolidAngle pdf_brdf, float weight,
                           const Rgb& contribution) {
  const std::uint32_t index = scene_.facets[hit.triangle].emitter;
  const Vec3 y(point_at(scene_.triangles[hit.triangle], hit.b1, hit.b2));
  events_.emplace_back(
      EmitterEvent{index, radiance, {pdf_brdf.value, light_densities(index, y)}, weight, contribution});
}

void PathRecorder::choice(bool light, float probability) {
  events_.emplace_back(ChoiceEvent{light, probability});
}

void PathRecorder::roulette(float survival, bool survived, const Rgb& throughput) {
  events_.emplace_back(RouletteEvent{survival, survived, throughput});
}

void PathRecorder::end(PathEnd why) {
  events_.emplace_back(EndEvent{why});
}

std::vector<float> PathRecorder::light_densities(std::uint32_t emitter, const Vec3& y) const {
  std::vector<float> densities;
  if (!from_) return densities;
  for (const auto& strategy : strategies_) {
    const LightQuery at = strategy->query(from_->x, from_->n, from_->reflection);
    densities.push_back(strategy->pdf(at, emitter, y).value);
  }
  return densities;
}

}  // namespace lemma
