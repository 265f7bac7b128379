#include "src/shading/phong.h"

#include "src/shading/phong_formulas.h"

namespace lemma {
namespace {

// Of ks, that an outline takes for diffuse: no light is ruled out by the lobe, and none chosen so rarely that
// it flickers where the outline is wrong.
constexpr float kLeastDiffuse = 0.05f;

float channel_sum(const Rgb& c) {
  return c.r + c.g + c.b;
}

float specular_factor(float n, const BrdfOptions& options) {
  if (options.lobe == Lobe::blinn_phong) return (n + 2) * (n + 4) / (8 * kPi * (std::exp2(-n / 2) + n));
  return (n + (options.norm == PhongNorm::n_plus_1 ? 1.0f : 2.0f)) * (0.5f * kInvPi);
}

/// Calls use() with the formulas of the material.
template <bool Specular, class Use>
auto with_formulas(const Material& m, const Use& use) {
  if (!Specular || is_black(m.ks)) return use(LambertFormulas());
  if (m.lobe == Lobe::blinn_phong) return use(MixtureFormulas<BlinnLobe>());
  return m.sampling == LobeSampling::truncated ? use(MixtureFormulas<PhongLobe<true>>())
                                               : use(MixtureFormulas<PhongLobe<false>>());
}

/// The choice of p6: by the channel sums.
float diffuse_probability(const Rgb& kd, const Rgb& ks) {
  const float diffuse = channel_sum(kd), specular = channel_sum(ks);
  return specular > 0 ? diffuse / (diffuse + specular) : 1.0f;
}

float outline_diffuse(const Rgb& kd, const Rgb& ks) {
  return (luminance(kd) + kLeastDiffuse * luminance(ks)) * kInvPi;
}

Reflection outline_of(const Rgb& kd, const Rgb& ks, float exponent, const BrdfOptions& options) {
  const float n = options.lobe == Lobe::phong ? exponent : exponent / 4;
  return {.diffuse = outline_diffuse(kd, ks),
          .peak = luminance(ks) * specular_factor(exponent, options),
          .width = 1 / (n + 1)};
}

}  // namespace

Material with_kd(const Material& material, const Rgb& kd) {
  Material other = material;
  other.kd = kd;
  other.diffuse_probability = diffuse_probability(kd, material.ks);
  other.outline.diffuse = outline_diffuse(kd, material.ks);
  return other;
}

Material make_material(const Rgb& kd, const Rgb& ks, float exponent, const BrdfOptions& options) {
  return {.kd = kd,
          .ks = ks,
          .exponent = exponent,
          .lobe = options.lobe,
          .sampling = options.sampling,
          .specular_factor = specular_factor(exponent, options),
          .diffuse_probability = diffuse_probability(kd, ks),
          .outline = outline_of(kd, ks, exponent, options)};
}

float largest_albedo(const Material& m) {
  // The Phong lobe without its factor reflects 2 pi / (n + 2) at normal incidence.
  const float lobe = m.lobe == Lobe::phong ? m.specular_factor * 2 * kPi / (m.exponent + 2) : 1;
  return max_channel(m.kd + m.ks * lobe);
}

template <bool Specular>
BrdfValue Phong<Specular>::at(const Vec3& wo, const Vec3& wi) const {
  return with_formulas<Specular>(material_, [&](auto formulas) { return formulas.at(material_, wo, wi); });
}

template <bool Specular>
std::optional<BrdfSample> Phong<Specular>::sample_part(const Vec3& wo, bool diffuse, const Vec2& u) const {
  const BrdfSample sample = with_formulas<Specular>(material_, [&](auto formulas) {
    return formulas.weigh(material_, wo, formulas.draw(material_, wo, diffuse, u));
  });
  if (!(sample.pdf.value > 0)) return std::nullopt;
  return sample;
}

template class Phong<false>;
template class Phong<true>;

}  // namespace lemma
