#include "src/lights/projected_triangle.h"
#include "src/lights/triangle_sampling.h"
#include "src/lights/weighted_emitters.h"

namespace lemma {
namespace {

/// The report's p3: p(triangle) ~ radiance x projected solid angle above the horizon, then a direction of
/// density ~ cosine at the surface. A part too small for that is sampled as `solid-angle` does; which way is
/// a function of point, normal and triangle alone.
class CosineView {
 public:
  static constexpr auto kMeasure = EmitterWeights::Measure::projected_solid_angle;

  CosineView(const Triangle& triangle, const LightQuery& at)
      : triangle_(triangle), at_(at), projected_(triangle, at.x, at.n) {}

  [[nodiscard]] Vec3d sample(const Vec2& u) const {
    return projected_.can_be_sampled()
               ? point_seen(triangle_, at_.x, projected_.sample(u))
               : sample_triangle(triangle_, SphericalTriangle(triangle_, at_.x), at_.x, u);
  }

  [[nodiscard]] PdfSolidAngle pdf(double pmf, const Connection& connection) const {
    if (!projected_.can_be_sampled()) {
      return triangle_pdf(pmf, triangle_, SphericalTriangle(triangle_, at_.x), connection);
    }
    const double cosine = dot(Vec3d(at_.n), connection.to_light) / std::sqrt(connection.distance2);
    return {static_cast<float>(pmf * std::max(cosine, 0.0) / projected_.projected_solid_angle())};
  }

 private:
  const Triangle& triangle_;
  const LightQuery& at_;
  ProjectedTriangle projected_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_projected(std::span<const Emitter> emitters,
                                                   std::span<const Triangle>) {
  return std::make_unique<WeightedEmitters<CosineView>>(emitters);
}

}  // namespace lemma
