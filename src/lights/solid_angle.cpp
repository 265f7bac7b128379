#include "src/lights/triangle_sampling.h"
#include "src/lights/weighted_emitters.h"

namespace lemma {
namespace {

/// The report's A.2: p(triangle) ~ radiance x the solid angle it covers, then a direction uniform in that
/// solid angle. A triangle too small on the sphere for that is sampled by area.
class UniformView {
 public:
  static constexpr auto kMeasure = EmitterWeights::Measure::solid_angle;

  UniformView(const Triangle& triangle, const LightQuery& at)
      : triangle_(triangle), x_(at.x), seen_(triangle, at.x) {}

  [[nodiscard]] Vec3d sample(const Vec2& u) const { return sample_triangle(triangle_, seen_, x_, u); }

  [[nodiscard]] PdfSolidAngle pdf(double pmf, const Connection& connection) const {
    return triangle_pdf(pmf, triangle_, seen_, connection);
  }

 private:
  const Triangle& triangle_;
  const Vec3& x_;
  SphericalTriangle seen_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_solid_angle(std::span<const Emitter> emitters,
                                                     std::span<const Triangle>) {
  return std::make_unique<WeightedEmitters<UniformView>>(emitters);
}

}  // namespace lemma
