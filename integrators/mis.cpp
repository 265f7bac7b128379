#include "integrators/path.h"

namespace lemma {
namespace {

/// The report's 7.3 as one path: light samples and BRDF samples, both weighted by the balance heuristic (eq.
/// (10)). The report recursed into both samples, 2 x 0.6 = 1.2 new paths a vertex: in a closed scene that
/// never ends.
struct BalancedSamples {
  static constexpr bool kSamplesLights = true;
  static float light_weight(PdfSolidAngle light, PdfSolidAngle brdf) {
    return balance_heuristic(light, brdf);
  }
  template <class LightPdf>
  static float brdf_weight(PdfSolidAngle brdf, const LightPdf& light) {
    return balance_heuristic(brdf, light());
  }
};

template <Model M>
using MisIntegrator = PathIntegrator<M, BalancedSamples>;

}  // namespace

std::unique_ptr<const Integrator> make_mis(const Model& model, const IntegratorOptions& options) {
  return for_model<MisIntegrator>(model, options);
}

}  // namespace lemma
