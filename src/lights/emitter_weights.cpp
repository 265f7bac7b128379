#include "src/lights/emitter_weights.h"

#include <algorithm>

namespace lemma {
namespace {

/// In 16 chains, so that no addition waits for the one before it.
double sum(const EmitterBlock::Values& weights) {
  constexpr std::size_t chains = 16;
  std::array<float, chains> partial{};
  for (std::size_t i = 0; i < weights.size(); i += chains) {
    for (std::size_t k = 0; k < chains; ++k) partial[k] += weights[i + k];
  }
  double total = 0;
  for (const float p : partial) total += p;
  return total;
}

/// Where the running sum passes `target`; the last positive weight if it never does.
std::uint32_t find(const EmitterBlock::Values& weights, double target) {
  double running = 0;
  std::uint32_t last = 0;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0) continue;
    running += weights[i];
    last = i;
    if (target < running) break;
  }
  return last;
}

}  // namespace

EmitterWeights::EmitterWeights(std::span<const Emitter> emitters, Measure measure) {
  const WeighEmitters& fastest = all_weigh_emitters().front();
  weigh_ = measure == Measure::solid_angle ? fastest.by_solid_angle : fastest.by_projected_solid_angle;
  for (std::size_t first = 0; first < emitters.size(); first += EmitterBlock::kSize) {
    blocks_.emplace_back(emitters.subspan(first, std::min(EmitterBlock::kSize, emitters.size() - first)));
  }
}

EmitterBlock::Values EmitterWeights::weigh(std::size_t block, const LightQuery& at) const {
  EmitterBlock::Values weights;
  weigh_(blocks_[block], {at.x, at.n}, weights);
  return weights;
}

void EmitterWeights::prepare(LightQuery& at) const {
  at.running_weights.clear();
  double running = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    running += sum(weigh(b, at));
    at.running_weights.push_back(running);
  }
}

std::optional<EmitterWeights::Choice> EmitterWeights::choose(const LightQuery& at, double u) const {
  const std::vector<double>& running = at.running_weights;
  const double total = running.back();
  if (!(total > 0)) return std::nullopt;
  // The first block whose sum exceeds the target has a positive weight; u < 1 keeps it in range.
  const double target = std::min(u * total, std::nextafter(total, 0.0));
  const auto passed = std::ranges::upper_bound(running, target);
  const auto block = static_cast<std::size_t>(passed - running.begin());
  const EmitterBlock::Values weights = weigh(block, at);
  const std::uint32_t within = find(weights, target - (block == 0 ? 0.0 : running[block - 1]));
  return Choice{static_cast<std::uint32_t>(block * EmitterBlock::kSize) + within, weights[within] / total};
}

double EmitterWeights::pmf(const LightQuery& at, std::uint32_t emitter) const {
  const double total = at.running_weights.back();
  if (!(total > 0)) return 0;
  return weigh(emitter / EmitterBlock::kSize, at)[emitter % EmitterBlock::kSize] / total;
}

}  // namespace lemma
