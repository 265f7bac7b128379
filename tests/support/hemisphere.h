#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/vec.h"
#include "src/shading/phong.h"

namespace lemma::test {

/// A unit direction at the angle theta from the z axis, in degrees.
[[nodiscard]] inline Vec3 direction(double theta_degrees, double phi = 0.3) {
  const double theta = theta_degrees * std::numbers::pi / 180;
  return {static_cast<float>(std::sin(theta) * std::cos(phi)),
          static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta))};
}

/// Spherical coordinates about an axis, in double: (1 - cos alpha, azimuth), the azimuth counted from the
/// side of z.
class AboutAxis {
 public:
  explicit AboutAxis(const Vec3& axis) : axis_(normalize(Vec3d(axis))) {
    const double across = std::hypot(axis_.x, axis_.y);
    up_ =
        across > 0 ? Vec3d(-axis_.x * axis_.z / across, -axis_.y * axis_.z / across, across) : Vec3d(1, 0, 0);
    side_ = cross(axis_, up_);
  }

  [[nodiscard]] Vec3 at(double one_minus_cos, double azimuth) const {
    const double sine = std::sqrt(std::max(0.0, one_minus_cos * (2 - one_minus_cos)));
    return Vec3(axis_ * (1 - one_minus_cos) + (up_ * std::cos(azimuth) + side_ * std::sin(azimuth)) * sine);
  }

  [[nodiscard]] double one_minus_cos(const Vec3& w) const {
    const Vec3d d = Vec3d(w) - axis_;
    return 0.5 * dot(d, d);
  }

  /// In (-pi, pi].
  [[nodiscard]] double azimuth(const Vec3& w) const {
    return std::atan2(dot(Vec3d(w), side_), dot(Vec3d(w), up_));
  }

 private:
  Vec3d axis_, up_, side_;
};

/// Mean of g(wi) over directions about an axis with density (n + 1) / (2 pi) cos^n(alpha), by the midpoint
/// rule in the two numbers such directions are drawn by.
template <class G>
[[nodiscard]] double lobe_mean(const Vec3& axis, double n, const G& g) {
  constexpr int rows = 600, columns = 600;
  const AboutAxis about(axis);
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const double one_minus_cos = -std::expm1(std::log((i + 0.5) / rows) / (n + 1));
    for (int j = 0; j < columns; ++j) {
      sum += g(about.at(one_minus_cos, 2 * std::numbers::pi * (j + 0.5) / columns));
    }
  }
  return sum / rows / columns;
}

/// Directional albedo of Blinn's lobe for ks = 1, by the midpoint rule over half vectors, dwi =
/// 4 (wo . h) dh.
[[nodiscard]] inline double blinn_albedo(float n, const Vec3& wo) {
  const Material material = make_material({}, {1, 1, 1}, n, {.lobe = Lobe::blinn_phong});
  return lobe_mean({0, 0, 1}, n, [&](const Vec3& h) {
    const float cos_h = dot(wo, h);
    const Vec3 wi = h * (2 * cos_h) - wo;
    if (cos_h <= 0 || wi.z <= 0) return 0.0;
    const double density = (n + 1) / (2 * std::numbers::pi) * std::pow(double{h.z}, double{n});
    return double{Phong<true>(material).eval(wo, wi).g} * wi.z * 4 * cos_h / density;
  });
}

}  // namespace lemma::test
