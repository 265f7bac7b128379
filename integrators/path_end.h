#pragma once

#include "integrators/integrator.h"
#include "integrators/path_record.h"

namespace lemma {

// The two ways to end a path that still has light to bring, the same for all integrators. Depths count the
// scattering events of a path, from 1 on.

/// Whether the depth limit forbids this scattering.
template <class Observer>
[[nodiscard]] bool is_cut(const IntegratorOptions& options, int depth, Tracer& tracer, Observer& observer) {
  if (depth <= options.max_depth) return false;
  ++tracer.counts.paths_cut;
  observer.end(PathEnd::cut);
  return true;
}

/// Whether the path goes on after this scattering; its throughput makes up for those that do not.
template <class Observer>
[[nodiscard]] inline bool survives_roulette(const IntegratorOptions& options, int depth, Rgb& throughput,
                                            Sampler& random, Observer& observer) {
  const float q = survival(options.roulette, depth, throughput);
  const bool alive = survives(q, throughput, random);
  observer.roulette(q, alive, throughput);
  return alive;
}

}  // namespace lemma
