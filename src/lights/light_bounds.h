#pragma once

#include "src/core/bounds.h"
#include "src/core/reflection.h"
#include "src/lights/emitter.h"

namespace lemma {

/// What a node of the light tree knows of the emitters below it: where they are, where they face, and how
/// much they emit. Sources: Conty Estevez, Kulla, Importance Sampling of Many Lights with Adaptive Tree
/// Splitting, HPG 2018; Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.6.3.
struct LightBounds {
  Bounds box;
  Vec3d axis;         // unit; the emitters' normals lie within ...
  double spread = 0;  // ... this angle of it, in [0, pi]
  double power = 0;   // sum of luminance x area

  explicit LightBounds(const Emitter& emitter);
  /// Of the emitters of both.
  LightBounds(const LightBounds& a, const LightBounds& b);
};

/// Estimate of the light that reaches a surface at x with normal n from emitters of these bounds. 0 only if
/// none of them can: no emitter faces x, or all lie below the horizon of n.
class LightImportance {
 public:
  explicit LightImportance(const LightBounds& bounds);

  [[nodiscard]] double operator()(const Vec3& x, const Vec3& n) const;

  /// The mean of what is reflected at x over the directions to the emitters, about.
  [[gnu::always_inline, nodiscard]] float reflected(const Vec3& x, const Reflection& reflection) const {
    const Vec3 to_centre = centre_ - x;
    const float distance2 = dot(to_centre, to_centre);
    const bool within = distance2 <= radius2_;  // then emitters may lie in any direction
    const float cosine = std::sqrt(1 - radius2_ / distance2), scale = 1 / std::sqrt(distance2);
    const auto either = [&](float a, float b) { return within ? a : b; };
    const Vec3 axis(either(reflection.mirror.x, to_centre.x * scale),
                    either(reflection.mirror.y, to_centre.y * scale),
                    either(reflection.mirror.z, to_centre.z * scale));
    return reflection.mean(axis, either(1, radius2_ / (distance2 * (1 + cosine))));
  }

 private:
  Vec3 centre_, axis_;
  float radius2_;  // of the sphere around the box
  float cos_spread_, sin_spread_;
  float power_;
};

}  // namespace lemma
