#pragma once

#include "src/scene/scene.h"

namespace lemma {

/// The part of the light that any triangle reflects at most, over channels and directions; 0 if none
/// reflects.
/// @param emitters_reflect  whether emitters count
[[nodiscard]] float largest_albedo(const Scene& scene, bool emitters_reflect);

}  // namespace lemma
