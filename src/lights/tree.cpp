#include "src/core/warp.h"
#include "src/lights/light_tree.h"
#include "src/lights/lobe_sector.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/triangle_sampling.h"

namespace lemma {
namespace {

constexpr float kLargestBelow1 = 1 - 0x1p-24f;

/// A whole light as seen from a point: directions uniform over the cone of its bounding sphere, or drawn by
/// the lobe of the surface there.
class WholeView {
 public:
  WholeView(const WholeLight& light, const LightQuery& at)
      : cone_(light.centre, light.radius, at.x), lobe_(LobeSector::find(at.reflection, cone_)) {}

  /// For u uniform in [0, 1)^2; nothing if the direction misses the cone.
  [[nodiscard]] std::optional<Vec3d> sample(const Sampler::ChoicePair& u) const {
    const auto [by_lobe, x] = decide(u.x, lobe_ ? lobe_->share() : 0);
    if (!by_lobe) return cone_.sample({x, u.y});
    const Vec3d w = lobe_->sample({x, u.y});
    return cone_.holds(w) ? std::optional(w) : std::nullopt;
  }

  /// @param to_light  within the cone
  [[nodiscard]] PdfSolidAngle pdf(double pmf, const Vec3d& to_light) const {
    const double uniform = 1 / cone_.solid_angle();
    if (!lobe_) return {static_cast<float>(pmf * uniform)};
    const double share = lobe_->share(), by_lobe = lobe_->pdf(normalize(to_light)).value;
    return {static_cast<float>(pmf * ((1 - share) * uniform + share * by_lobe))};
  }

 private:
  SphereCone cone_;
  std::optional<LobeSector> lobe_;
};

/// A light by a tree (light_tree.h), by what the surface reflects of it, at a cost that grows with the
/// logarithm of their number; then a direction uniform over its solid angle, or that of a WholeView if it is
/// a whole light.
class TreeSampler final : public LightSampler {
 public:
  explicit TreeSampler(std::span<const Emitter> emitters) : emitters_(emitters), tree_(emitters) {}

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const auto [x, y] = random.next_choice_pair();
    const auto light = tree_.choose(at, x);
    if (!light) return std::nullopt;
    if (light->whole != nullptr) return sample_whole(at, *light, {light->u, y});
    const Vec2 u(std::min(static_cast<float>(light->u), kLargestBelow1), y);
    return light->quad != nullptr ? sample_quad(at, *light, u) : sample_emitter(at, *light, u);
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    const LightTree::Choice light = tree_.choice_of(at, emitter);
    if (light.whole != nullptr) return WholeView(*light.whole, at).pdf(light.pmf, connection->to_light);
    if (light.quad != nullptr) return light.quad->pdf(light.pmf, emitter, *connection);
    const Triangle& triangle = emitters_[emitter].shape;
    if (tree_.samples_area(at.x, emitter)) return area_pdf(light.pmf, triangle, *connection);
    return triangle_pdf(light.pmf, triangle, SphericalTriangle(triangle, at.x), *connection);
  }

  const WholeLight* whole_of(std::uint32_t emitter) const override { return tree_.whole_of(emitter); }

 private:
  [[nodiscard]] std::optional<LightSample> sample_whole(const LightQuery& at, const LightTree::Choice& light,
                                                        const Sampler::ChoicePair& u) const {
    const WholeView seen(*light.whole, at);
    const auto w = seen.sample(u);
    if (!w) return std::nullopt;
    const PdfSolidAngle pdf = seen.pdf(light.pmf, *w);
    if (!(pdf.value > 0)) return std::nullopt;
    const Vec3 wi(*w);
    return LightSample{.wi = wi,
                       .pdf = pdf,
                       .radiance = emitters_[light.whole->emitters.front()].radiance,
                       .to_light = wi,
                       .whole = light.whole};
  }

  [[nodiscard]] std::optional<LightSample> sample_quad(const LightQuery& at, const LightTree::Choice& light,
                                                       const Vec2& u) const {
    const auto [emitter, y] = light.quad->sample(u);
    return make_sample(at, emitter, y,
                       [&, e = emitter](const Connection& c) { return light.quad->pdf(light.pmf, e, c); });
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
