#pragma once

#include "src/core/vec.h"
#include "src/shading/phong.h"

namespace lemma::test {

/// The ways to draw a direction: the Phong lobe whole or cut at the horizon, Blinn's lobe.
inline constexpr BrdfOptions kSamplings[] = {
    {.sampling = LobeSampling::truncated}, {.sampling = LobeSampling::p6}, {.lobe = Lobe::blinn_phong}};

[[nodiscard]] inline Material mixed(float exponent, const BrdfOptions& options) {
  return make_material({0.3f, 0.3f, 0.3f}, {0.5f, 0.5f, 0.5f}, exponent, options);
}

[[nodiscard]] inline Material lobe_alone(float exponent, const BrdfOptions& options) {
  return make_material({}, {1, 1, 1}, exponent, options);
}

[[nodiscard]] inline Vec3 mirror(const Vec3& wo) {
  return {-wo.x, -wo.y, wo.z};
}

}  // namespace lemma::test
