#include "integrators/path.h"

namespace lemma {

std::unique_ptr<const Integrator> make_direct(const Model& model, const IntegratorOptions& options);
std::unique_ptr<const Integrator> make_brdf(const Model& model, const IntegratorOptions& options);

namespace {

/// The report's 7.3 as one path: light samples and BRDF samples, both weighted by a heuristic. The report
/// recursed into both samples, 2 x 0.6 = 1.2 new paths a vertex: in a closed scene that never ends.
template <PairWeight Weight>
struct WeightedSamples {
  static constexpr bool kSamplesLights = true;
  static float light_weight(PdfSolidAngle light, PdfSolidAngle brdf) { return Weight(light, brdf); }
  template <class LightPdf>
  static float brdf_weight(PdfSolidAngle brdf, const LightPdf& light) {
    return Weight(brdf, light());
  }
};

template <Model M>
using BalanceIntegrator = PathIntegrator<M, WeightedSamples<balance_heuristic>>;
template <Model M>
using PowerIntegrator = PathIntegrator<M, WeightedSamples<power_heuristic>>;

}  // namespace

std::unique_ptr<const Integrator> make_mis(const Model& model, const IntegratorOptions& options) {
  if (options.counted_samples == CountedSamples::light) return make_direct(model, options);
  if (options.counted_samples == CountedSamples::brdf) return make_brdf(model, options);
  return options.heuristic == Heuristic::balance ? for_model<BalanceIntegrator>(model, options)
                                                 : for_model<PowerIntegrator>(model, options);
}

}  // namespace lemma
