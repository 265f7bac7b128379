#pragma once

#include "src/core/elementary.h"
#include "src/core/vec.h"

namespace lemma {

/// A BRDF in outline, in luminance, for choosing among lights:
///   f(w) ~ diffuse + peak exp(-(1 - cos(w, mirror)) / width)
/// Choices made by it need not be exact, but `diffuse` must be positive wherever any light is reflected, so
/// that no light is ruled out by how narrow a lobe is.
struct Reflection {
  Vec3 mirror{0, 0, 1};  // unit; about it lies the lobe ...
  float diffuse = 1;
  float peak = 0;   // ... of this height
  float width = 1;  // and this solid angle / (2 pi): 1 / (n + 1) of cos^n

  /// The mean of f over a cone of directions, about. A lobe exp(-(1 - cos) / width) is nearly a Gaussian in
  /// the plane across its axis; the cone is taken for one of the same integral, (1 - cos) wide. Over it the
  /// lobe is as wide as both together and as much lower: right for either much narrower than the other, in
  /// the middle, and never far below at the cone's rim.
  /// @param axis           unit
  /// @param one_minus_cos  of the cone's half angle
  [[nodiscard]] float mean(const Vec3& axis, float one_minus_cos) const {
    const Vec3 apart = axis - mirror;
    const float both = width + one_minus_cos;
    const float fallen = elementary::decay(0.5f * dot(apart, apart) / both);
    return diffuse + peak * (width / both) * fallen;
  }
};

}  // namespace lemma
