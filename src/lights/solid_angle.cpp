#include "src/core/warp.h"
#include "src/lights/connection.h"
#include "src/lights/emitter_weights.h"
#include "src/lights/spherical_triangle.h"

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
    const Emitter& emitter = emitters_[i];
    const SphericalTriangle seen(emitter.shape, at.x);
    const auto connection = connect(emitter, at.x,
                                    seen.can_be_sampled() ? point_seen(emitter.shape, at.x, seen.sample(u))
                                                          : point_by_area(emitter.shape, u));
    if (!connection) return std::nullopt;
    const PdfSolidAngle pdf = density(at, i, seen, *connection);
    if (!(pdf.value > 0)) return std::nullopt;
    return make_light_sample(emitters_, i, at.x, *connection, pdf);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    if (!(at.total_weight > 0)) return {0};
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    return density(at, emitter, SphericalTriangle(emitters_[emitter].shape, at.x), *connection);
  }

 private:
  static Vec3d point_by_area(const Triangle& t, const Vec2& u) {
    const auto [b1, b2] = uniform_triangle(u);
    return point_at(t, b1, b2);
  }

  /// Where the direction w from x meets the triangle, moved onto it where rounding led past its edge.
  static Vec3d point_seen(const Triangle& t, const Vec3& x, const Vec3d& w) {
    const Vec3d v0(t.v0), e1 = Vec3d(t.v1) - v0, e2 = Vec3d(t.v2) - v0, s = Vec3d(x) - v0;
    const Vec3d p = cross(w, e2), q = cross(s, e1);
    const double determinant = dot(e1, p);
    const double b1 = std::clamp(dot(s, p) / determinant, 0.0, 1.0);
    const double b2 = std::clamp(dot(w, q) / determinant, 0.0, 1.0 - b1);
    return point_at(t, b1, b2);
  }

  [[nodiscard]] PdfSolidAngle density(const LightQuery& at, std::size_t emitter,
                                      const SphericalTriangle& seen, const Connection& c) const {
    const double pmf = weights_.weight(at.x, emitter) / at.total_weight;
    if (seen.can_be_sampled()) return {static_cast<float>(pmf / seen.solid_angle())};
    return to_solid_angle({static_cast<float>(pmf / area(emitters_[emitter].shape))}, c.distance2,
                          c.cos_light);
  }

  std::span<const Emitter> emitters_;
  EmitterWeights weights_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_solid_angle(std::span<const Emitter> emitters) {
  return std::make_unique<SolidAngleSampler>(emitters);
}

}  // namespace lemma
