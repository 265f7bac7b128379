#include "src/measure/stop_rule.h"

#include <algorithm>
#include <cmath>

namespace lemma {
namespace {

/// Less than this part of the samples so far is not worth a pass.
constexpr double kSmallestPass = 1.0 / 16;

/// Samples that will be there when time is up, at the speed so far.
std::uint64_t spp_in_time(const PassState& state, double seconds) {
  if (state.spp == 0) return 1;
  const double more = (seconds - state.seconds) * state.spp / std::max(state.seconds, 1e-9);
  if (more < std::max(1.0, kSmallestPass * state.spp)) return state.spp;
  return state.spp + static_cast<std::uint64_t>(std::min(more, 4.0 * state.spp));
}

/// Samples at which the error should be small enough if it falls as one over their number.
std::uint64_t spp_for_error(const PassState& state, double relmse) {
  if (state.spp < StopRule::kFirstLook) return StopRule::kFirstLook;
  if (state.relmse <= relmse) return state.spp;
  const double quarters = std::ceil(4 * (state.relmse / relmse - 1));
  return state.spp + static_cast<std::uint64_t>(std::min(quarters, 4.0)) * (state.spp / 4);
}

}  // namespace

std::uint32_t next_spp(const StopRule& rule, const PassState& state) {
  std::uint64_t next = rule.spp;
  if (rule.seconds) next = std::min(next, spp_in_time(state, *rule.seconds));
  if (rule.relmse) next = std::min(next, spp_for_error(state, *rule.relmse));
  const std::uint64_t doubled = std::max<std::uint64_t>(1, 2 * std::uint64_t{state.spp});
  if (rule.looks || rule.seconds) next = std::min(next, doubled);
  return static_cast<std::uint32_t>(next);
}

}  // namespace lemma
