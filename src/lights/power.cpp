#include <vector>

#include "src/lights/area_sampling.h"

namespace lemma {

/// p(triangle) ~ radiance x area: the alternative of the report's A.1.
std::unique_ptr<const LightSampler> make_power(std::span<const Emitter> emitters, std::span<const Triangle>) {
  std::vector<double> weights;
  for (const Emitter& e : emitters) weights.push_back(luminance(e.radiance) * area(e.shape));
  return make_area_sampler(emitters, weights);
}

}  // namespace lemma
