#include "src/shading/phong.h"

#include "src/core/warp.h"
#include "src/shading/lobe.h"

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

/// Calls use(lobe) with the lobe of the material.
template <class Use>
auto with_lobe(const Material& m, const Vec3& wo, const Use& use) {
  if (m.lobe == Lobe::blinn_phong) return use(BlinnLobe(wo, m.exponent));
  return m.sampling == LobeSampling::truncated ? use(PhongLobe<true>(wo, m.exponent))
                                               : use(PhongLobe<false>(wo, m.exponent));
}

Rgb value(const Material& m, float cos_n) {
  return m.kd * kInvPi + m.ks * (m.specular_factor * cos_n);
}

template <class SomeLobe>
float mixture_pdf(const Material& m, const SomeLobe& lobe, const Vec3& wi, float cos_n) {
  const float p = m.diffuse_probability;
  return p * wi.z * kInvPi + (1 - p) * lobe.pdf(wi, cos_n);
}

template <class SomeLobe>
std::optional<BrdfSample> sample_mixture(const Material& m, const SomeLobe& lobe, bool diffuse,
                                         const Vec2& u) {
  const Vec3 wi = diffuse ? cosine_hemisphere(u) : lobe.sample(u);
  if (wi.z <= 0) return std::nullopt;
  const float cos_n = lobe.cos_n(wi), density = mixture_pdf(m, lobe, wi, cos_n);
  if (density <= 0) return std::nullopt;
  return BrdfSample{wi, {density}, value(m, cos_n) * (wi.z / density)};
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
  if (wo.z <= 0 || wi.z <= 0) return {};
  if (is_lambert()) return {material_.kd * kInvPi, {wi.z * kInvPi}};
  return with_lobe(material_, wo, [&](const auto& lobe) {
    const float cos_n = lobe.cos_n(wi);
    return BrdfValue{value(material_, cos_n), {mixture_pdf(material_, lobe, wi, cos_n)}};
  });
}

template <bool Specular>
std::optional<BrdfSample> Phong<Specular>::sample_part(const Vec3& wo, bool diffuse, const Vec2& u) const {
  if (wo.z <= 0) return std::nullopt;
  if (is_lambert()) {
    if (is_black(material_.kd)) return std::nullopt;
    const Vec3 wi = cosine_hemisphere(u);
    return BrdfSample{wi, {wi.z * kInvPi}, material_.kd};
  }
  return with_lobe(material_, wo,
                   [&](const auto& lobe) { return sample_mixture(material_, lobe, diffuse, u); });
}

template <bool Specular>
bool Phong<Specular>::is_lambert() const {
  return !Specular || is_black(material_.ks);
}

template class Phong<false>;
template class Phong<true>;

}  // namespace lemma
