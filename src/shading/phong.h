#pragma once

#include <optional>

#include "src/core/pdf.h"
#include "src/core/rgb.h"
#include "src/core/vec.h"

namespace lemma {

/// The factor in front of the Phong lobe: (n + 1) / (2 pi), the report's eq. (3), or (n + 2) / (2 pi), which
/// makes the albedo at normal incidence 1 for ks = 1.
enum class PhongNorm { n_plus_1, n_plus_2 };

/// What a surface reflects. All values linear, per channel.
struct Material {
  Rgb kd;              // diffuse albedo [1]
  Rgb ks;              // specular coefficient [1]
  float exponent = 1;  // n >= 0

  float specular_factor = 0;      // (n + 1) / (2 pi) or (n + 2) / (2 pi) [sr^-1]
  float diffuse_probability = 1;  // kd : ks, by their channel sums; the choice of p6
};

/// Fills in the derived values from kd, ks and exponent.
[[nodiscard]] Material make_material(const Rgb& kd, const Rgb& ks, float exponent, PhongNorm norm);

/// A direction drawn from a BRDF.
struct BrdfSample {
  Vec3 wi;            // unit, local frame, wi.z > 0
  PdfSolidAngle pdf;  // of the whole mixture
  Rgb weight;         // f cos(theta_i) / pdf
};

/// A Lambert term and a Phong lobe about the mirror direction, in a local frame whose z axis is the shading
/// normal:
///   f = kd / pi + ks (n + 1) / (2 pi) max(0, cos alpha)^n,   alpha between wi and the mirror direction of wo
/// (the report's eq. (3); Lafortune and Willems, Using the Modified Phong Reflectance Model, 1994). wo and wi
/// are unit, both leave the surface; f and pdf are 0 unless both z > 0. With Specular = false only the
/// Lambert term exists: scenes without ks pay nothing for the lobe.
template <bool Specular>
class Phong {
 public:
  explicit Phong(const Material& material) : material_(material) {}

  /// f(wo, wi) [sr^-1], without the cosine.
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const;

  /// Density with which sample() returns wi.
  [[nodiscard]] PdfSolidAngle pdf(const Vec3& wo, const Vec3& wi) const;

  /// The report's p6: diffuse or specular by kd : ks, then the cosine-weighted hemisphere or the lobe.
  /// @param choice, u  uniform in [0, 1)
  /// @return nothing if the material is black or the lobe's direction lies below the surface
  [[nodiscard]] std::optional<BrdfSample> sample(const Vec3& wo, float choice, const Vec2& u) const;

 private:
  const Material& material_;
};

extern template class Phong<false>;
extern template class Phong<true>;

}  // namespace lemma
