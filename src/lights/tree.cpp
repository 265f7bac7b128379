#include "src/lights/light_tree.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/triangle_sampling.h"

namespace lemma {
namespace {

/// A light by a tree (light_tree.h), at a cost that grows with the logarithm of their number; then a
/// direction uniform over its solid angle, or over the cone of its bounding sphere if it is a whole light. Of
/// a whole light the sample is the emitter that the direction meets first, or nothing if it passes by.
class TreeSampler final : public LightSampler {
 public:
  explicit TreeSampler(std::span<const Emitter> emitters) : emitters_(emitters), tree_(emitters) {}

  LightQuery query(const Vec3& x, const Vec3& n) const override { return {x, n}; }

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const double choice = random.next_bits() * 0x1p-32;
    const Vec2 u = random.next_2d();
    const auto light = tree_.choose(at, choice);
    if (!light) return std::nullopt;
    const auto point = light->whole != nullptr
                           ? tree_.first_hit(light->node, at.x, cone(*light->whole, at.x).sample(u))
                           : point_on(light->emitter, at.x, u);
    if (!point) return std::nullopt;
    const auto connection = connect(emitters_[point->emitter], at.x, point->y);
    if (!connection) return std::nullopt;
    const PdfSolidAngle pdf = density(at, *light, *connection);
    if (!(pdf.value > 0)) return std::nullopt;
    return make_light_sample(emitters_, point->emitter, at.x, *connection, pdf);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    return density(at, tree_.choice_of(at, emitter), *connection);
  }

 private:
  static SphereCone cone(const WholeLight& light, const Vec3& x) { return {light.centre, light.radius, x}; }

  [[nodiscard]] std::optional<LightTree::EmitterPoint> point_on(std::uint32_t emitter, const Vec3& x,
                                                                const Vec2& u) const {
    const Triangle& triangle = emitters_[emitter].shape;
    return LightTree::EmitterPoint{emitter, sample_triangle(triangle, SphericalTriangle(triangle, x), x, u)};
  }

  [[nodiscard]] PdfSolidAngle density(const LightQuery& at, const LightTree::Choice& light,
                                      const Connection& connection) const {
    if (light.whole != nullptr) {
      return {static_cast<float>(light.pmf / cone(*light.whole, at.x).solid_angle())};
    }
    const Triangle& triangle = emitters_[light.emitter].shape;
    return triangle_pdf(light.pmf, triangle, SphericalTriangle(triangle, at.x), connection);
  }

  std::span<const Emitter> emitters_;
  LightTree tree_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_tree(std::span<const Emitter> emitters) {
  return std::make_unique<TreeSampler>(emitters);
}

}  // namespace lemma
