#pragma once

#include "src/lights/connection.h"
#include "src/lights/emitter_weights.h"

namespace lemma {

/// p(triangle) ~ its weight as seen from the point, over all emitter triangles, then a point of it. What the
/// triangle looks like from there is View(triangle, at), with
///   kMeasure              what the weights are
///   sample(u)             the point, for u uniform in [0,1)^2
///   pdf(pmf, connection)  density of its direction, times the probability `pmf` of the triangle
template <class View>
class WeightedEmitters final : public LightSampler {
 public:
  explicit WeightedEmitters(std::span<const Emitter> emitters)
      : emitters_(emitters), weights_(emitters, View::kMeasure) {}

  void reserve(LightQuery& at) const override { weights_.reserve(at); }
  void prepare(LightQuery& at) const override { weights_.prepare(at); }

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const double choice = random.next_bits() * 0x1p-32;
    const Vec2 u = random.next_2d();
    const auto chosen = weights_.choose(at, choice);
    if (!chosen) return std::nullopt;
    const Emitter& emitter = emitters_[chosen->emitter];
    const View view(emitter.shape, at);
    const auto connection = connect(emitter, at.x, view.sample(u));
    if (!connection) return std::nullopt;
    const PdfSolidAngle pdf = view.pdf(chosen->pmf, *connection);
    if (!(pdf.value > 0)) return std::nullopt;
    return make_light_sample(emitters_, chosen->emitter, at.x, *connection, pdf);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    return View(emitters_[emitter].shape, at).pdf(weights_.pmf(at, emitter), *connection);
  }

 private:
  std::span<const Emitter> emitters_;
  EmitterWeights weights_;
};

}  // namespace lemma
