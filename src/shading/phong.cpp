#include "src/shading/phong.h"

#include "src/core/frame.h"
#include "src/core/warp.h"

namespace lemma {
namespace {

float channel_sum(const Rgb& c) {
  return c.r + c.g + c.b;
}

Vec3 mirror(const Vec3& wo) {
  return {-wo.x, -wo.y, wo.z};
}

/// cos(alpha)^n for unit a, b. 1 - cos(alpha) is |a - b|^2 / 2, which does not cancel: pow(dot(a, b), n)
/// loses all digits at n = 1e5.
float cos_power(const Vec3& a, const Vec3& b, float n) {
  const Vec3 d = a - b;
  const float one_minus_cos = 0.5f * dot(d, d);
  if (one_minus_cos >= 1) return 0;
  return std::exp(n * std::log1p(-one_minus_cos));
}

float lobe_pdf(const Vec3& wo, const Vec3& wi, float n) {
  return (n + 1) * (0.5f * kInvPi) * cos_power(mirror(wo), wi, n);
}

/// A direction about `axis` with density (n + 1) / (2 pi) cos(alpha)^n: 1 - cos(alpha) = 1 - (1 - u)^(1 / (n
/// + 1)), by expm1 so that narrow lobes keep their digits.
Vec3 sample_lobe(const Vec3& axis, float n, const Vec2& u) {
  const float one_minus_cos = -std::expm1(std::log1p(-u.x) / (n + 1));
  const float sin_alpha = std::sqrt(one_minus_cos * (2 - one_minus_cos));
  const float phi = 2 * kPi * u.y;
  return frame_around(axis).to_world(
      {sin_alpha * std::cos(phi), sin_alpha * std::sin(phi), 1 - one_minus_cos});
}

}  // namespace

Material make_material(const Rgb& kd, const Rgb& ks, float exponent, PhongNorm norm) {
  const float diffuse = channel_sum(kd), specular = channel_sum(ks);
  const float offset = norm == PhongNorm::n_plus_1 ? 1.0f : 2.0f;
  return {.kd = kd,
          .ks = ks,
          .exponent = exponent,
          .specular_factor = (exponent + offset) * (0.5f * kInvPi),
          .diffuse_probability = specular > 0 ? diffuse / (diffuse + specular) : 1.0f};
}

template <bool Specular>
Rgb Phong<Specular>::eval(const Vec3& wo, const Vec3& wi) const {
  if (wo.z <= 0 || wi.z <= 0) return {};
  const Rgb diffuse = material_.kd * kInvPi;
  if constexpr (!Specular) return diffuse;
  if (is_black(material_.ks)) return diffuse;
  return diffuse + material_.ks * (material_.specular_factor * cos_power(mirror(wo), wi, material_.exponent));
}

template <bool Specular>
PdfSolidAngle Phong<Specular>::pdf(const Vec3& wo, const Vec3& wi) const {
  if (wo.z <= 0 || wi.z <= 0) return {0};
  const float diffuse = wi.z * kInvPi;
  if constexpr (!Specular) return {diffuse};
  const float p = material_.diffuse_probability;
  if (p == 1) return {diffuse};
  return {p * diffuse + (1 - p) * lobe_pdf(wo, wi, material_.exponent)};
}

template <bool Specular>
std::optional<BrdfSample> Phong<Specular>::sample(const Vec3& wo, float choice, const Vec2& u) const {
  if (is_black(material_.kd) && (!Specular || is_black(material_.ks))) return std::nullopt;
  if (wo.z <= 0) return std::nullopt;
  const bool diffuse = !Specular || choice < material_.diffuse_probability;
  const Vec3 wi = diffuse ? cosine_hemisphere(u) : sample_lobe(mirror(wo), material_.exponent, u);
  if (wi.z <= 0) return std::nullopt;
  if (!Specular || material_.diffuse_probability == 1) return BrdfSample{wi, {wi.z * kInvPi}, material_.kd};

  const float cos_n = cos_power(mirror(wo), wi, material_.exponent);
  const float p = material_.diffuse_probability;
  const float density = p * wi.z * kInvPi + (1 - p) * (material_.exponent + 1) * (0.5f * kInvPi) * cos_n;
  if (density <= 0) return std::nullopt;
  const Rgb f = material_.kd * kInvPi + material_.ks * (material_.specular_factor * cos_n);
  return BrdfSample{wi, {density}, f * (wi.z / density)};
}

template class Phong<false>;
template class Phong<true>;

}  // namespace lemma
