#pragma once

#include <optional>
#include <vector>

#include "accel/accelerator.h"
#include "src/lights/light_sampler.h"

namespace lemma::test {

/// The triangles as emitters of one light, of the same radiance in all channels.
[[nodiscard]] std::vector<Emitter> emitters_of(const std::vector<Triangle>& triangles, float radiance,
                                               std::uint32_t light);

/// Two sphere lights of different size and radiance, above the plane y = 0.
[[nodiscard]] std::vector<Emitter> two_spheres();

/// Lambert's formula: irradiance [W m^-2 per radiance 1] that a triangle sends to x with normal n, horizon
/// respected: the triangle is cut by it. 0 from behind.
[[nodiscard]] double irradiance(const Emitter& emitter, const Vec3& x, const Vec3& n);

/// Draws light samples and finds the emitters that directions to whole lights meet.
class LightDraws {
 public:
  LightDraws(const LightSampler& lights, std::span<const Emitter> emitters);

  /// A sample that names its emitter; nothing if it comes to nothing or passes its whole light by.
  [[nodiscard]] std::optional<LightSample> operator()(const LightQuery& at, Sampler& random) const;

 private:
  const LightSampler& lights_;
  std::vector<Triangle> triangles_;  // of each emitter
  std::unique_ptr<const Accelerator> accel_;
};

}  // namespace lemma::test
