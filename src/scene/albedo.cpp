#include "src/scene/albedo.h"

#include <algorithm>

namespace lemma {
namespace {

/// Glass may reflect all of the light, and a texture be white.
float albedo_of(const Scene& scene, std::uint32_t material) {
  if (scene.needs.model.glass && scene.glass[material].ior != 1) return 1;
  if (scene.needs.model.textures && scene.texture_of[material].texture != kNoTexture) {
    return largest_albedo(with_kd(scene.materials[material], scene.texture_of[material].tint));
  }
  return largest_albedo(scene.materials[material]);
}

}  // namespace

float largest_albedo(const Scene& scene, bool emitters_reflect) {
  float largest = 0;
  for (const Facet& facet : scene.facets) {
    if (facet.emitter != kNoEmitter && !emitters_reflect) continue;
    largest = std::max(largest, albedo_of(scene, facet.material));
  }
  return largest;
}

}  // namespace lemma
