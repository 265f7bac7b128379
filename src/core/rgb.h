#pragma once

#include <algorithm>

namespace lemma {

/// Linear colour, Rec. 709 primaries: a radiance [W m^-2 sr^-1], an albedo [1] or a BRDF value [sr^-1]. Not a
/// vector: it has no dot product.
struct Rgb {
  float r = 0, g = 0, b = 0;

  Rgb& operator+=(const Rgb& o) { return r += o.r, g += o.g, b += o.b, *this; }
  Rgb& operator*=(const Rgb& o) { return r *= o.r, g *= o.g, b *= o.b, *this; }
  Rgb& operator*=(float s) { return r *= s, g *= s, b *= s, *this; }
  friend Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
  friend Rgb operator*(Rgb a, const Rgb& b) { return a *= b; }
  friend Rgb operator*(Rgb a, float s) { return a *= s; }
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Relative luminance (Rec. 709 weights).
[[nodiscard]] inline float luminance(const Rgb& c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

[[nodiscard]] inline float max_channel(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}

[[nodiscard]] inline bool is_black(const Rgb& c) {
  return c.r == 0 && c.g == 0 && c.b == 0;
}

}  // namespace lemma
