#include "src/lights/light_sampler.h"

namespace lemma {

// The table of strategies: a new one is a file that defines make_ID, and a line here.
// clang-format off
#define LEMMA_LIGHT_SAMPLERS(entry)                                                                          \
  entry(tree, "tree", "as solid-angle, at a cost that hardly grows with the number of triangles: round "     \
                      "lights as a whole, others by a light tree")                                           \
  entry(power, "power", "triangle by radiance x area, point by area")                                        \
  entry(solid_angle, "solid-angle", "triangle by radiance x solid angle seen from the point, direction "     \
                                    "uniform")                                                               \
  entry(projected, "projected", "triangle by radiance x solid angle above the horizon x cosine at the "      \
                                "surface, direction by that cosine")                                         \
  entry(radiance_area, "radiance-area", "light by radiance, triangle and point by area (the report's A.1)")
// clang-format on

#define LEMMA_DECLARE(id, name, help) \
  std::unique_ptr<const LightSampler> make_##id(std::span<const Emitter>, std::span<const Triangle>);
LEMMA_LIGHT_SAMPLERS(LEMMA_DECLARE)

std::span<const Named<LightSamplerFactory>> light_samplers() {
#define LEMMA_ENTRY(id, name, help) {name, make_##id, help},
  static constexpr Named<LightSamplerFactory> table[] = {LEMMA_LIGHT_SAMPLERS(LEMMA_ENTRY)};
  return table;
}

}  // namespace lemma
