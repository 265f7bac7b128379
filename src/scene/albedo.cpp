#include "src/scene/albedo.h"

#include <algorithm>

namespace lemma {

float largest_albedo(const Scene& scene, bool emitters_reflect) {
  float largest = 0;
  for (const Facet& facet : scene.facets) {
    if (facet.emitter != kNoEmitter && !emitters_reflect) continue;
    largest = std::max(largest, largest_albedo(scene.materials[facet.material]));
  }
  return largest;
}

}  // namespace lemma
