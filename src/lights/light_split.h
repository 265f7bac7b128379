#pragma once

#include <span>

#include "src/lights/light_bounds.h"

namespace lemma {

/// Something that a leaf of the tree under construction stands for.
struct LightItem {
  LightBounds bounds;
  enum class Kind { emitter, whole, quad };
  Kind kind = Kind::emitter;
  std::uint32_t index = 0;  // among those of its kind
};

/// Sorts two or more items into those of a node's first and second child and returns how many the first one
/// gets, at least one and not all. Of the splits between 12 bins along each axis it takes the one that costs
/// least, where a side costs its power x the area of its box x the solid angle its emitters can reach.
/// Source: Conty Estevez, Kulla, Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG 2018,
/// section 4.1.
[[nodiscard]] std::size_t split_lights(std::span<LightItem> items);

}  // namespace lemma
