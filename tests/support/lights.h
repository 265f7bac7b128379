#pragma once

#include <vector>

#include "src/lights/emitter.h"

namespace lemma::test {

/// The triangles as emitters of one light, of the same radiance in all channels.
[[nodiscard]] std::vector<Emitter> emitters_of(const std::vector<Triangle>& triangles, float radiance,
                                               std::uint32_t light);

/// Two sphere lights of different size and radiance, above the plane y = 0.
[[nodiscard]] std::vector<Emitter> two_spheres();

/// Lambert's formula: irradiance [W m^-2 per radiance 1] that a triangle sends to x with normal n, horizon
/// respected: the triangle is cut by it. 0 from behind.
[[nodiscard]] double irradiance(const Emitter& emitter, const Vec3& x, const Vec3& n);

}  // namespace lemma::test
