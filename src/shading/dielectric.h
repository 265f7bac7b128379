#pragma once

#include "src/core/rgb.h"
#include "src/core/vec.h"

namespace lemma {

/// A smooth boundary between two media, of which the one in front is the one that z points into.
struct Dielectric {
  float ior = 1;      // index of refraction behind the boundary over that in front, > 0
  Rgb transmittance;  // of what passes the boundary [1]
};

/// Part of unpolarised light that a smooth boundary reflects; 1 beyond the critical angle.
/// @param cos_i  cosine of the angle to the normal, in [0, 1], on the side the light comes from
/// @param eta    index of refraction on the other side over that on this side
/// Source: Born and Wolf, Principles of Optics, 7th ed., 1.5.2.
[[nodiscard]] float fresnel(float cos_i, float eta);

/// Where light goes on at a boundary: mirrored or refracted, a direction of its own each.
struct DielectricSample {
  Vec3 wi;     // unit, local frame
  Rgb weight;  // of the path that goes on
  bool refracted = false;
};

/// Chooses between reflection and refraction by the Fresnel equations, so that the weight is 1 or the
/// transmittance. Radiance along a path is radiance divided by the square of the medium's index, which
/// refraction leaves as it is (Nicodemus 1963); cameras and lights stand in a medium of index 1.
/// @param wo      unit, local frame, on either side; wo.z is not 0
/// @param choice  uniform in [0, 1)
[[nodiscard]] DielectricSample sample_dielectric(const Dielectric& boundary, const Vec3& wo, float choice);

}  // namespace lemma
