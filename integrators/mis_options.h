#pragma once

#include <span>

#include "src/core/named.h"
#include "src/core/pdf.h"

namespace lemma {

/// How multiple importance sampling weighs a sample that both techniques could have made.
enum class Heuristic {
  balance,  // by density: the report's eq. (10)
  power     // by squared density
};

[[nodiscard]] std::span<const Named<Heuristic>> heuristics();

/// The weight of a sample of density a where the other technique has density b.
[[nodiscard]] inline float mis_weight(Heuristic heuristic, PdfSolidAngle a, PdfSolidAngle b) {
  return heuristic == Heuristic::balance ? balance_heuristic(a, b) : power_heuristic(a, b);
}

/// Which samples find emitted light. One kind alone has weight 1: what each is good for shows beside `both`,
/// as in Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, figure 9.2.
enum class CountedSamples { both, light, brdf };

[[nodiscard]] std::span<const Named<CountedSamples>> counted_samples();

}  // namespace lemma
