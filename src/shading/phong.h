#pragma once

#include <optional>

#include "src/core/pdf.h"
#include "src/core/reflection.h"
#include "src/core/rgb.h"
#include "src/core/sampler.h"
#include "src/core/vec.h"
#include "src/core/warp.h"
#include "src/shading/brdf_options.h"

namespace lemma {

/// What a surface reflects. All values linear, per channel.
struct Material {
  Rgb kd;              // diffuse albedo [1]
  Rgb ks;              // specular coefficient [1]
  float exponent = 1;  // n >= 0
  Lobe lobe = Lobe::phong;
  LobeSampling sampling = LobeSampling::truncated;

  float specular_factor = 0;      // in front of the lobe, as Lobe and PhongNorm say [sr^-1]
  float diffuse_probability = 1;  // kd : ks, by their channel sums; the choice of p6
  Reflection outline = {};        // for any mirror direction
};

/// Fills in the derived values. The factor of Blinn's lobe makes its albedo at normal incidence 1 for ks = 1:
/// (n + 2) (n + 4) / (8 pi (2^(-n/2) + n)); PhongNorm does not touch it.
[[nodiscard]] Material make_material(const Rgb& kd, const Rgb& ks, float exponent,
                                     const BrdfOptions& options = {});

/// The material with another diffuse albedo, as a texture gives it.
[[nodiscard]] Material with_kd(const Material& material, const Rgb& kd);

/// The material's BRDF in outline for a direction whose mirror direction is given. Blinn's lobe is about that
/// of n / 4 there, since the half vector turns by half the angle.
[[nodiscard]] inline Reflection outline(const Material& material, const Vec3& mirror) {
  const Reflection& any = material.outline;
  return {.mirror = mirror, .diffuse = any.diffuse, .peak = any.peak, .width = any.width};
}

/// The part of the light that the material reflects at most, over channels and directions: that at normal
/// incidence.
[[nodiscard]] float largest_albedo(const Material& material);

/// A direction drawn from a BRDF.
struct BrdfSample {
  Vec3 wi;            // unit, local frame, wi.z > 0
  PdfSolidAngle pdf;  // of the whole mixture
  Rgb weight;         // f cos(theta_i) / pdf
};

/// What a BRDF says of a pair of directions.
struct BrdfValue {
  Rgb f;              // [sr^-1], without the cosine
  PdfSolidAngle pdf;  // with which sample() returns wi
};

/// A Lambert term and a specular lobe, in a local frame whose z axis is the shading normal:
///   f = kd / pi + ks (n + 1) / (2 pi) max(0, cos alpha)^n
/// with alpha between wi and the mirror direction of wo (the report's eq. (3)), or the other factor and angle
/// that BrdfOptions chose. wo and wi are unit, both leave the surface; f and pdf are 0 unless both z > 0.
/// With Specular = false only the Lambert term exists: scenes without ks pay nothing for the lobe.
template <bool Specular>
class Phong {
 public:
  explicit Phong(const Material& material) : material_(material) {}

  /// Value and density share the lobe's power: who needs both asks once.
  [[nodiscard]] BrdfValue at(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const { return at(wo, wi).f; }
  [[nodiscard]] PdfSolidAngle pdf(const Vec3& wo, const Vec3& wi) const { return at(wo, wi).pdf; }

  /// The report's p6: diffuse or specular by kd : ks, then the cosine-weighted hemisphere or the lobe, of
  /// which LobeSampling::truncated draws only the part above the surface.
  /// @param choice, u  uniform in [0, 1)
  /// @return nothing if the material is black or the lobe's direction lies below the surface, which
  /// directions
  ///   of the truncated lobe do by rounding alone
  [[nodiscard]] std::optional<BrdfSample> sample(const Vec3& wo, float choice, const Vec2& u) const {
    return sample_part(wo, choice < material_.diffuse_probability, u);
  }

  /// The same for a pair uniform in [0, 1)^2, of which x also decides.
  [[nodiscard]] std::optional<BrdfSample> sample(const Vec3& wo, const Sampler::ChoicePair& u) const {
    const auto [diffuse, x] = decide(u.x, material_.diffuse_probability);
    return sample_part(wo, diffuse, {x, u.y});
  }

 private:
  [[nodiscard]] std::optional<BrdfSample> sample_part(const Vec3& wo, bool diffuse, const Vec2& u) const;

  const Material& material_;
};

extern template class Phong<false>;
extern template class Phong<true>;

}  // namespace lemma
