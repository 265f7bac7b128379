#include "integrators/mis_options.h"

namespace lemma {

std::span<const Named<Heuristic>> heuristics() {
  static constexpr Named<Heuristic> table[] = {
      {"power", Heuristic::power, "by squared density"},
      {"balance", Heuristic::balance, "by density (the report's eq. (10))"}};
  return table;
}

std::span<const Named<CountedSamples>> counted_samples() {
  static constexpr Named<CountedSamples> table[] = {
      {"both", CountedSamples::both, "light and BRDF samples, weighted"},
      {"light", CountedSamples::light, "light samples alone, as --integrator direct"},
      {"brdf", CountedSamples::brdf, "BRDF samples alone, as --integrator brdf"}};
  return table;
}

}  // namespace lemma
