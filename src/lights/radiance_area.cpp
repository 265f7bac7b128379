#include <map>
#include <vector>

#include "src/lights/area_sampling.h"

namespace lemma {

/// The report's A.1: p(light) ~ radiance, whatever its size; p(triangle | light) ~ area.
std::unique_ptr<const LightSampler> make_radiance_area(std::span<const Emitter> emitters,
                                                       std::span<const Triangle>) {
  std::map<std::uint32_t, double> light_area;
  for (const Emitter& e : emitters) light_area[e.light] += area(e.shape);
  std::vector<double> weights;
  for (const Emitter& e : emitters) {
    weights.push_back(luminance(e.radiance) * area(e.shape) / light_area[e.light]);
  }
  return make_area_sampler(emitters, weights);
}

}  // namespace lemma
