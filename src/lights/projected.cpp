#include "src/lights/emitter_weights.h"
#include "src/lights/projected_triangle.h"
#include "src/lights/triangle_sampling.h"

namespace lemma {
namespace {

/// The report's p3: p(triangle) ~ radiance x projected solid angle above the horizon, over all emitter
/// triangles, then a direction of density ~ cosine at the surface. A part too small for that is sampled as
/// `solid-angle` does; which way is a function of point, normal and triangle alone.
class ProjectedSampler final : public LightSampler {
 public:
  explicit ProjectedSampler(std::span<const Emitter> emitters)
      : emitters_(emitters), weights_(emitters, EmitterWeights::Measure::projected_solid_angle) {}

  LightQuery query(const Vec3& x, const Vec3& n) const override { return weights_.query(x, n); }

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const double choice = random.next_bits() * 0x1p-32;
    const Vec2 u = random.next_2d();
    const auto chosen = weights_.choose(at, choice);
    if (!chosen) return std::nullopt;
    const Emitter& emitter = emitters_[chosen->emitter];
    const ProjectedTriangle projected(emitter.shape, at.x, at.n);
    const Vec3d y = projected.can_be_sampled()
                        ? point_seen(emitter.shape, at.x, projected.sample(u))
                        : sample_triangle(emitter.shape, SphericalTriangle(emitter.shape, at.x), at.x, u);
    const auto connection = connect(emitter, at.x, y);
    if (!connection) return std::nullopt;
    const PdfSolidAngle pdf = density(at, *chosen, projected, *connection);
    if (!(pdf.value > 0)) return std::nullopt;
    return make_light_sample(emitters_, chosen->emitter, at.x, *connection, pdf);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    const ProjectedTriangle projected(emitters_[emitter].shape, at.x, at.n);
    return density(at, {emitter, weights_.pmf(at, emitter)}, projected, *connection);
  }

 private:
  [[nodiscard]] PdfSolidAngle density(const LightQuery& at, const EmitterWeights::Choice& chosen,
                                      const ProjectedTriangle& projected,
                                      const Connection& connection) const {
    const Triangle& triangle = emitters_[chosen.emitter].shape;
    if (!projected.can_be_sampled()) {
      return triangle_pdf(chosen.pmf, triangle, SphericalTriangle(triangle, at.x), connection);
    }
    const double cosine = dot(Vec3d(at.n), connection.to_light) / std::sqrt(connection.distance2);
    return {static_cast<float>(chosen.pmf * std::max(cosine, 0.0) / projected.projected_solid_angle())};
  }

  std::span<const Emitter> emitters_;
  EmitterWeights weights_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_projected(std::span<const Emitter> emitters) {
  return std::make_unique<ProjectedSampler>(emitters);
}

}  // namespace lemma
