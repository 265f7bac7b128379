#include "src/lights/emitter_weights.h"
#include "src/lights/triangle_sampling.h"

namespace lemma {
namespace {

/// The report's A.2: p(triangle) ~ radiance x the solid angle it covers, over all emitter triangles, then a
/// direction uniform in that solid angle. A triangle too small on the sphere for that is sampled by area.
class SolidAngleSampler final : public LightSampler {
 public:
  explicit SolidAngleSampler(std::span<const Emitter> emitters) : emitters_(emitters), weights_(emitters) {}

  LightQuery query(const Vec3& x, const Vec3& n) const override { return {x, n, weights_.total(x)}; }

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const double target = at.total_weight * (random.next_bits() * 0x1p-32);
    const Vec2 u = random.next_2d();
    if (!(at.total_weight > 0)) return std::nullopt;
    const std::size_t i = weights_.find(at.x, target);
    const Triangle& triangle = emitters_[i].shape;
    const SphericalTriangle seen(triangle, at.x);
    const auto connection = connect(emitters_[i], at.x, sample_triangle(triangle, seen, at.x, u));
    if (!connection) return std::nullopt;
    const PdfSolidAngle pdf = triangle_pdf(pmf(at, i), triangle, seen, *connection);
    if (!(pdf.value > 0)) return std::nullopt;
    return make_light_sample(emitters_, i, at.x, *connection, pdf);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    if (!(at.total_weight > 0)) return {0};
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    const Triangle& triangle = emitters_[emitter].shape;
    return triangle_pdf(pmf(at, emitter), triangle, SphericalTriangle(triangle, at.x), *connection);
  }

 private:
  [[nodiscard]] double pmf(const LightQuery& at, std::size_t emitter) const {
    return weights_.weight(at.x, emitter) / at.total_weight;
  }

  std::span<const Emitter> emitters_;
  EmitterWeights weights_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_solid_angle(std::span<const Emitter> emitters) {
  return std::make_unique<SolidAngleSampler>(emitters);
}

}  // namespace lemma
