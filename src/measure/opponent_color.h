#pragma once

#include <array>
#include <cmath>

namespace lemma {

/// The colour spaces of FLIP, all of white D65. Sources: Andersson et al., FLIP: A Difference Evaluator for
/// Alternating Images, HPG 2020, 3 and 4; the matrix from the primaries of IEC 61966-2-1.
using Color = std::array<double, 3>;

namespace opponent {

inline constexpr Color kWhite = {0.950428545, 1.0, 1.088900371};

[[nodiscard]] inline Color xyz_from_linear(const Color& rgb) {
  constexpr double a = 24577794, b = 12288897, c = 73733382;
  const auto [red, green, blue] = rgb;
  return {(10135552 * red + 8788810 * green + 4435075 * blue) / a,
          (2613072 * red + 8788810 * green + 887015 * blue) / b,
          (1425312 * red + 8788810 * green + 70074185 * blue) / c};
}

[[nodiscard]] inline Color linear_from_xyz(const Color& xyz) {
  const auto [x, y, z] = xyz;
  return {3.241003275 * x - 1.537398934 * y - 0.498615861 * z,
          -0.969224334 * x + 1.875930071 * y + 0.041554224 * z,
          0.055639423 * x - 0.204011202 * y + 1.057148933 * z};
}

[[nodiscard]] inline double linear_from_srgb(double c) {
  return c > 0.04045 ? std::pow((c + 0.055) / 1.055, 2.4) : c / 12.92;
}

/// Luminance, red against green, blue against yellow: linear in XYZ.
[[nodiscard]] inline Color ycxcz_from_xyz(const Color& xyz) {
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

[[nodiscard]] inline Color xyz_from_ycxcz(const Color& color) {
  const double y = (color[0] + 16) / 116;
  return {(y + color[1] / 500) * kWhite[0], y * kWhite[1], (y - color[2] / 200) * kWhite[2]};
}

/// CIELAB with the Hunt effect: colours are less colourful in the dark.
[[nodiscard]] inline Color hunt_lab_from_xyz(const Color& xyz) {
  constexpr double delta = 6.0 / 29;
  const auto f = [](double t) {
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

/// City-block in lightness, Euclidean in the other two.
[[nodiscard]] inline double hyab(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

}  // namespace opponent
}  // namespace lemma
