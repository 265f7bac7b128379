#pragma once

#include "src/scene/scene.h"

namespace lemma::test {

// Scenes made here, of 16 x 16 pixels. First a glossy floor under lights that the camera does not see:

/// 10,000 small triangles that face all ways.
[[nodiscard]] Scene many_lights();

/// Two spheres that run into each other, and a triangle that runs through both.
[[nodiscard]] Scene overlapping_lights();

/// A light that stands upright, its lower part below the floor.
/// @param block  whether something stands beside it
[[nodiscard]] Scene light_below_horizon(bool block = true);

/// A room that light cannot leave, whose ceiling emits; a panel that emits hangs below it, so that directions
/// meet two lights, and a ball hides both from parts of the floor. Lobes from wide ones, which the horizon
/// cuts, to sharp ones; the largest albedo is 0.65, below sqrt(0.6), the limit of roulette `fixed`.
[[nodiscard]] Scene glossy_room(const BrdfOptions& brdf);

/// Puts another light, thrice as bright, into the place of each.
void double_lights(Scene& scene);

}  // namespace lemma::test
