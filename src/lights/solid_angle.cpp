#include "src/lights/emitter_weights.h"
#include "src/lights/triangle_sampling.h"

namespace lemma {
namespace {

/// The report's A.2: p(triangle) ~ radiance x the solid angle it covers, over all emitter triangles, then a
/// direction uniform in that solid angle. A triangle too small on the sphere for that is sampled by area.
class SolidAngleSampler final : public LightSampler {
 public:
  explicit SolidAngleSampler(std::span<const Emitter> emitters)
      : emitters_(emitters), weights_(emitters, EmitterWeights::Measure::solid_angle) {}

  LightQuery query(const Vec3& x, const Vec3& n) const override { return weights_.query(x, n); }

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const double choice = random.next_bits() * 0x1p-32;
    const Vec2 u = random.next_2d();
    const auto chosen = weights_.choose(at, choice);
    if (!chosen) return std::nullopt;
    const Emitter& emitter = emitters_[chosen->emitter];
    const SphericalTriangle seen(emitter.shape, at.x);
    const auto connection = connect(emitter, at.x, sample_triangle(emitter.shape, seen, at.x, u));
    if (!connection) return std::nullopt;
    const PdfSolidAngle pdf = triangle_pdf(chosen->pmf, emitter.shape, seen, *connection);
    if (!(pdf.value > 0)) return std::nullopt;
    return make_light_sample(emitters_, chosen->emitter, at.x, *connection, pdf);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    const Triangle& triangle = emitters_[emitter].shape;
    return triangle_pdf(weights_.pmf(at, emitter), triangle, SphericalTriangle(triangle, at.x), *connection);
  }

 private:
  std::span<const Emitter> emitters_;
  EmitterWeights weights_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_solid_angle(std::span<const Emitter> emitters) {
  return std::make_unique<SolidAngleSampler>(emitters);
}

}  // namespace lemma
