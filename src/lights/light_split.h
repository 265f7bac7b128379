#pragma once

#include <span>

#include "src/lights/light_bounds.h"

namespace lemma {

/// Something that a leaf of the tree under construction stands for.
struct LightItem {
  LightBounds bounds;
  std::uint32_t index = 0;  // of a whole light or of an emitter ...
  bool whole = false;       // ... as this says
};

/// Sorts two or more items into those of a node's first and second child and returns how many the first one
/// gets, at least one and not all. Of the splits between 12 bins along each axis it takes the one that costs
/// least, where a side costs its power x the area of its box x the solid angle its emitters can reach.
/// Source: Conty Estevez, Kulla, Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG 2018,
/// section 4.1.
[[nodiscard]] std::size_t split_lights(std::span<LightItem> items);

}  // namespace lemma
