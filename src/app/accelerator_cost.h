#pragma once

#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace lemma {

/// What an accelerator takes for a scene.
struct AcceleratorCost {
  std::string name;
  double build_seconds = 0;
  std::size_t bytes = 0;
  double seconds_a_sample = 0;  // of the camera, on all threads
};

/// Builds each accelerator and renders a few pixels of the scene with it, with the options that `lemma
/// render` has when none are given: a second or so in all. Brute force is left out where even that would take
/// long.
[[nodiscard]] std::vector<AcceleratorCost> measure_costs(const Scene& scene);

}  // namespace lemma
