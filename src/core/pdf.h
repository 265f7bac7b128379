#pragma once

#include <cmath>

namespace lemma {

/// A probability density that carries its measure in its type, so that an area density cannot be used where a
/// solid-angle density belongs. Infinite for a technique whose support has measure zero.
template <class Measure>
struct Pdf {
  float value = 0;
};
using PdfArea = Pdf<struct PerArea>;              // [scene unit^-2]
using PdfSolidAngle = Pdf<struct PerSolidAngle>;  // [sr^-1]

/// The density of the direction to a point at distance^2 whose surface is seen at cos_light > 0.
[[nodiscard]] inline PdfSolidAngle to_solid_angle(PdfArea p, double distance2, double cos_light) {
  return {static_cast<float>(p.value * distance2 / cos_light)};
}

/// The weight of a sample of the technique with density a when the one with density b could have made it too,
/// one sample each: a / (a + b). 0 when a is 0; no overflow.
/// Source: Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, eq. 9.8; the report's eq.
/// (10).
[[nodiscard]] inline float balance_heuristic(PdfSolidAngle a, PdfSolidAngle b) {
  if (a.value == 0) return 0;
  if (std::isinf(a.value)) return 1;
  return 1 / (1 + b.value / a.value);
}

/// As balance_heuristic, with squared densities: a^2 / (a^2 + b^2). Their ratio is squared, so that neither
/// densities of 1e30 nor of 1e-30 overflow or vanish.
/// Source: Veach 1997, eq. 9.10 with beta = 2.
[[nodiscard]] inline float power_heuristic(PdfSolidAngle a, PdfSolidAngle b) {
  if (a.value == 0) return 0;
  if (std::isinf(a.value)) return 1;
  const float ratio = b.value / a.value;
  return 1 / (1 + ratio * ratio);
}

}  // namespace lemma
