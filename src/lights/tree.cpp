#include "src/core/warp.h"
#include "src/lights/light_tree.h"
#include "src/lights/triangle_sampling.h"
#include "src/lights/whole_core.h"
#include "src/lights/whole_view.h"

namespace lemma {
namespace {

constexpr float kLargestBelow1 = 1 - 0x1p-24f;

/// Whole lights that a point sees.
WholeView view_of(const WholeLight& light, const LightQuery& at) {
  const SphereCone cone(light.centre, light.radius, at.x);
  return {cone, LobeSector::find(at.reflection, cone).value_or(LobeSector())};
}

WholeCore core_of(const WholeLight& light) {
  return {light.centre, light.core, light.shell};
}

/// A light by a tree (light_tree.h), by what the surface reflects of it, at a cost that grows with the
/// logarithm of their number; then a direction uniform over its solid angle, or that of a WholeView if it is
/// a whole light.
class TreeSampler final : public LightSampler, private LightWaveSampler {
 public:
  TreeSampler(std::span<const Emitter> emitters, std::span<const Triangle> triangles)
      : emitters_(emitters), tree_(emitters, triangles), row_(tree_.row()), row_waves_(light_row_waves()) {}

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    return sample(at, random.next_partner_pair());
  }

  const LightWaveSampler* waves() const override { return row_ ? this : nullptr; }

  void sample_wave(const LightQueryWave& at, std::size_t count, const ChoicePairWave& u,
                   LightSampleWave& samples) const override {
    LightRowScratch& s = scratch();
    row_waves_.sample(*row_, at, count, u, s, samples);
    for (std::size_t i = 0; i < count; ++i) {
      if (s.undone[i] == 0) continue;
      const std::optional<LightSample> single = sample(at[i], Sampler::ChoicePair{u.x[i], u.y[i]});
      samples.pdf[i] = 0;
      if (single) samples.set(i, *single);
    }
  }

  void pdf_wave(const LightQueryWave& at, std::size_t count, const Wave<std::uint32_t>& emitter,
                const VecWave& y, Wave<float>& pdfs) const override {
    LightRowScratch& s = scratch();
    row_waves_.pdf(*row_, at, count, emitter, y, s, pdfs);
    for (std::size_t i = 0; i < count; ++i) {
      if (s.undone[i] != 0) pdfs[i] = pdf(at[i], emitter[i], y[i]).value;
    }
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    if (!connection) return {0};
    const LightTree::Choice light = tree_.choice_of(at, emitter);
    if (light.whole != nullptr) return view_of(*light.whole, at).pdf(light.pmf, connection->to_light);
    if (light.quad != nullptr) return light.quad->pdf(light.pmf, emitter, *connection);
    const Triangle& triangle = emitters_[emitter].shape;
    if (tree_.samples_area(at.x, emitter)) return area_pdf(light.pmf, triangle, *connection);
    return triangle_pdf(light.pmf, triangle, SphericalTriangle(triangle, at.x), *connection);
  }

  const WholeLight* whole_of(std::uint32_t emitter) const override { return tree_.whole_of(emitter); }

 private:
  /// Of one wave at a time.
  static LightRowScratch& scratch() {
    thread_local LightRowScratch of_thread;
    return of_thread;
  }

  [[nodiscard]] std::optional<LightSample> sample(const LightQuery& at, const Sampler::ChoicePair& u) const {
    const auto light = tree_.choose(at, u.x);
    if (!light) return std::nullopt;
    if (light->whole != nullptr) return sample_whole(at, *light, {light->u, u.y});
    const Vec2 v(std::min(static_cast<float>(light->u), kLargestBelow1), u.y);
    return light->quad != nullptr ? sample_quad(at, *light, v) : sample_emitter(at, *light, v);
  }

  [[nodiscard]] std::optional<LightSample> sample_whole(const LightQuery& at, const LightTree::Choice& light,
                                                        const Sampler::ChoicePair& u) const {
    const WholeView seen = view_of(*light.whole, at);
    const auto [within, w] = seen.sample(u.x, u.y);
    const PdfSolidAngle pdf = seen.pdf(light.pmf, w);
    if (!within || !(pdf.value > 0)) return std::nullopt;
    const Vec3 wi(w);
    return LightSample{.wi = wi,
                       .pdf = pdf,
                       .radiance = emitters_[light.whole->emitters.front()].radiance,
                       .to_light = wi,
                       .visible_until = core_of(*light.whole).visible_until(at.x, wi),
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
  std::optional<LightRow> row_;
  LightRowWaves row_waves_;
};

}  // namespace

std::unique_ptr<const LightSampler> make_tree(std::span<const Emitter> emitters,
                                              std::span<const Triangle> triangles) {
  return std::make_unique<TreeSampler>(emitters, triangles);
}

}  // namespace lemma
