#pragma once

#include <array>
#include <numbers>

#include "src/core/vec.h"

namespace lemma {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;

/// Unit direction about z with density cos(theta) / pi [sr^-1], from u uniform in [0,1)^2; z > 0.
/// Malley's method: a point of the unit disk, lifted. z = sqrt(1 - u.x) needs no cancelling difference.
[[nodiscard]] inline Vec3 cosine_hemisphere(const Vec2& u) {
  const float r = std::sqrt(u.x);
  const float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.x)};
}

/// Barycentric coordinates (b1, b2) uniform over a triangle, from u uniform in [0,1)^2.
/// Source: Turk, Generating Random Points in Triangles, Graphics Gems, 1990.
[[nodiscard]] inline std::array<double, 2> uniform_triangle(const Vec2& u) {
  const double root = std::sqrt(static_cast<double>(u.x));
  return {root * (1.0 - u.y), root * u.y};
}

}  // namespace lemma
