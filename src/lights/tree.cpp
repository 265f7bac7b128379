#include "src/lights/light_tree.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/triangle_sampling.h"

namespace lemma {
namespace {

/// A light by a tree (light_tree.h), by what the surface reflects of it, at a cost that grows with the
/// logarithm of their number; then a direction uniform over its solid angle, or over the cone of its bounding
/// sphere if it is a whole light. Of a whole light the sample is the emitter that the direction meets first,
/// or nothing if it passes by.
class TreeSampler final : public LightSampler {
 public:
  explicit TreeSampler(std::span<const Emitter> emitters) : emitters_(emitters), tree_(emitters) {}

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const double choice = random.next_bits() * 0x1p-32;
    const Vec2 u = random.next_2d();
    const auto light = tree_.choose(at, choice);
    if (!light) return std::nullopt;
    return light->whole != nullptr ? sample_whole(at, *light, u) : sample_emitter(at, *light, u);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    const LightTree::Choice light = tree_.choice_of(at, emitter);
    if (light.whole != nullptr) return whole_pdf(light.pmf, cone(*light.whole, at.x));
    const Triangle& triangle = emitters_[emitter].shape;
    if (tree_.samples_area(at.x, emitter)) return area_pdf(light.pmf, triangle, *connection);
    return triangle_pdf(light.pmf, triangle, SphericalTriangle(triangle, at.x), *connection);
  }

 private:
  static SphereCone cone(const LightTree::Whole& light, const Vec3& x) {
    return {light.body.centre, light.body.radius, x};
  }

  static PdfSolidAngle whole_pdf(double pmf, const SphereCone& cone) {
    return {static_cast<float>(pmf / cone.solid_angle())};
  }

  [[nodiscard]] std::optional<LightSample> sample_whole(const LightQuery& at, const LightTree::Choice& light,
                                                        const Vec2& u) const {
    const SphereCone seen = cone(*light.whole, at.x);
    const auto point = light.whole->mesh.first_hit(at.x, seen.sample(u));
    if (!point) return std::nullopt;
    return make_sample(at, point->emitter, point->y,
                       [&](const Connection&) { return whole_pdf(light.pmf, seen); });
  }

  [[nodiscard]] std::optional<LightSample> sample_emitter(const LightQuery& at,
                                                          const LightTree::Choice& light,
                                                          const Vec2& u) const {
    const Triangle& triangle = emitters_[light.emitter].shape;
    if (tree_.samples_area(at.x, light.emitter)) {
      return make_sample(at, light.emitter, sample_area(triangle, u),
                         [&](const Connection& c) { return area_pdf(light.pmf, triangle, c); });
    }
    const SphericalTriangle seen(triangle, at.x);
    return make_sample(at, light.emitter, sample_triangle(triangle, seen, at.x, u),
                       [&](const Connection& c) { return triangle_pdf(light.pmf, triangle, seen, c); });
  }

  template <class Density>
  [[nodiscard]] std::optional<LightSample> make_sample(const LightQuery& at, std::uint32_t emitter,
                                                       const Vec3d& y, const Density& density) const {
    const auto connection = connect(emitters_[emitter], at.x, y);
    if (!connection) return std::nullopt;
    const PdfSolidAngle pdf = density(*connection);
    if (!(pdf.value > 0)) return std::nullopt;
    return make_light_sample(emitters_, emitter, at.x, *connection, pdf);
  }

  std::span<const Emitter> emitters_;
  LightTree tree_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_tree(std::span<const Emitter> emitters) {
  return std::make_unique<TreeSampler>(emitters);
}

}  // namespace lemma
