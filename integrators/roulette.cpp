#include "integrators/roulette.h"

namespace lemma {

std::span<const Named<Roulette>> roulettes() {
  static constexpr Named<Roulette> table[] = {
      {"throughput", Roulette::throughput,
       "survive with three times the path's throughput, at most 1, from the third scattering on"},
      {"fixed", Roulette::fixed,
       "survive with probability 0.6 (the report's section 5); for albedos below 0.775 only (0.63 with "
       "mis-report), the variance is infinite in closed scenes of others"}};
  return table;
}

bool has_infinite_variance(Roulette roulette, float albedo, float spread) {
  return roulette == Roulette::fixed && spread * albedo * albedo >= kFixedSurvival;
}

}  // namespace lemma
