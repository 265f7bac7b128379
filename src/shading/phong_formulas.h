#pragma once

#include "src/core/warp.h"
#include "src/shading/lobe.h"
#include "src/shading/phong.h"

// What Phong<> finds, for single paths and for lanes of waves: without calls, and inlined whatever its size.
// A sample of pdf 0 stands for none.
namespace lemma {

/// As that of directions (lobe.h).
[[gnu::always_inline, nodiscard]] inline Rgb select(bool condition, const Rgb& a, const Rgb& b) {
  return {condition ? a.r : b.r, condition ? a.g : b.g, condition ? a.b : b.b};
}

/// The Lambert term alone: Phong<false>, and materials without ks.
struct LambertFormulas {
  [[gnu::always_inline, nodiscard]] static BrdfValue at(const Material& m, const Vec3& wo, const Vec3& wi) {
    if (wo.z <= 0 || wi.z <= 0) return {};
    return {m.kd * kInvPi, {wi.z * kInvPi}};
  }

  [[gnu::always_inline, nodiscard]] static Vec3 draw(const Material& /*m*/, const Vec3& /*wo*/,
                                                     bool /*diffuse*/, const Vec2& u) {
    return cosine_hemisphere(u);
  }

  [[gnu::always_inline, nodiscard]] static BrdfSample weigh(const Material& m, const Vec3& wo,
                                                            const Vec3& wi) {
    const bool lost = (wo.z <= 0) | is_black(m.kd);
    return {wi, {lost ? 0.0f : wi.z * kInvPi}, select(lost, {}, m.kd)};
  }
};

/// The mixture with SomeLobe, a class of lobe.h.
template <class SomeLobe>
struct MixtureFormulas {
  [[gnu::always_inline, nodiscard]] static BrdfValue at(const Material& m, const Vec3& wo, const Vec3& wi) {
    if (wo.z <= 0 || wi.z <= 0) return {};
    return above(m, SomeLobe(wo, m.exponent), wi);
  }

  [[gnu::always_inline, nodiscard]] static Vec3 draw(const Material& m, const Vec3& wo, bool diffuse,
                                                     const Vec2& u) {
    return diffuse ? cosine_hemisphere(u) : SomeLobe(wo, m.exponent).sample(u);
  }

  [[gnu::always_inline, nodiscard]] static BrdfSample weigh(const Material& m, const Vec3& wo,
                                                            const Vec3& wi) {
    const auto [f, pdf] = above(m, SomeLobe(wo, m.exponent), wi);
    // The weight of materials without ks is that of LambertFormulas: it needs no division, nor has its
    // rounding.
    const bool lambert = is_black(m.ks);
    const bool lost = (wo.z <= 0) | (wi.z <= 0) | (pdf.value <= 0) | (lambert & is_black(m.kd));
    return {wi, {lost ? 0.0f : pdf.value}, select(lambert, m.kd, f * (wi.z / pdf.value))};
  }

 private:
  /// Both directions above the surface. The density may be 0, where there is nothing diffuse.
  [[gnu::always_inline, nodiscard]] static BrdfValue above(const Material& m, const SomeLobe& lobe,
                                                           const Vec3& wi) {
    const float cos_n = lobe.cos_n(wi), p = m.diffuse_probability;
    return {m.kd * kInvPi + m.ks * (m.specular_factor * cos_n),
            {p * wi.z * kInvPi + (1 - p) * lobe.pdf(wi, cos_n)}};
  }
};

}  // namespace lemma
