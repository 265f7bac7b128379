#pragma once

#include "src/core/triangle.h"

namespace lemma {

/// The triangle as seen from x, on the unit sphere, in double.
class SphericalTriangle {
 public:
  SphericalTriangle(const Triangle& triangle, const Vec3& x);

  /// The angle that the triangle covers, in [0, 2 pi) [sr]; 0 when x lies in its plane or on it.
  /// Omega = 2 atan2(|a . (e1 x e2)|, |a||b||c| + (a . b)|c| + (b . c)|a| + (c . a)|b|) with the edges e1, e2
  /// taken from the vertices as stored: differences of unit vectors would lose all digits of a small
  /// triangle. Sources: Van Oosterom, Strackee, The Solid Angle of a Plane Triangle, IEEE Trans. Biomed. Eng.
  /// 30(2), 1983; Eriksson, On the Measure of Solid Angles, Mathematics Magazine 63(3), 1990.
  [[nodiscard]] double solid_angle() const { return solid_angle_; }

  /// Whether sample() keeps its accuracy. Triangles smaller than this have so little spread of distance and
  /// cosine that sampling their area serves as well.
  [[nodiscard]] bool can_be_sampled() const { return can_be_sampled_; }

  /// Unit direction from x, uniform over the solid angle, for u uniform in [0,1)^2.
  /// Sources: Arvo, Stratified Sampling of Spherical Triangles, SIGGRAPH 1995 (the map); Peters, BRDF
  /// Importance Sampling for Polygonal Lights, SIGGRAPH 2021 (its arithmetic, which has no angle of the
  /// triangle near 0 to divide by).
  [[nodiscard]] Vec3d sample(const Vec2& u) const;

 private:
  Vec3d a_, b_, c_;  // unit directions to the vertices
  double volume_ = 0, solid_angle_ = 0;
  bool can_be_sampled_ = false;
};

}  // namespace lemma
