#pragma once

#include "src/scene/scene.h"

namespace lemma::test {

// A glossy floor under lights that the camera does not see, made here: 16 x 16 pixels.

/// 10,000 small triangles that face all ways.
[[nodiscard]] Scene many_lights();

/// Two spheres that run into each other, and a triangle that runs through both.
[[nodiscard]] Scene overlapping_lights();

/// A light that stands upright, its lower part below the floor.
/// @param block  whether something stands beside it
[[nodiscard]] Scene light_below_horizon(bool block = true);

}  // namespace lemma::test
