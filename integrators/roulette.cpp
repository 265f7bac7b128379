#include "integrators/roulette.h"

namespace lemma {
namespace {

constexpr float kFixedSurvival = 0.6f;  // the report's
constexpr int kFirstThroughputDepth = 3;
constexpr float kSmallestSurvival = 0.05f;  // bounds the weight of the paths that go on

float survival(Roulette roulette, int depth, const Rgb& throughput) {
  if (roulette == Roulette::fixed) return kFixedSurvival;
  if (depth < kFirstThroughputDepth) return 1;
  return std::clamp(max_channel(throughput), kSmallestSurvival, 1.0f);
}

}  // namespace

std::span<const Named<Roulette>> roulettes() {
  static constexpr Named<Roulette> table[] = {
      {"throughput", Roulette::throughput,
       "survive with the path's throughput, from the third scattering on"},
      {"fixed", Roulette::fixed, "survive with probability 0.6 (the report's section 5)"}};
  return table;
}

bool survives(Roulette roulette, int depth, Rgb& throughput, Sampler& random) {
  const float q = survival(roulette, depth, throughput);
  if (q == 1) return true;
  if (random.next() >= q) return false;
  throughput *= 1 / q;
  return true;
}

}  // namespace lemma
