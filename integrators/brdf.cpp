#include "integrators/path.h"

namespace lemma {
namespace {

/// The report's 7.2: light is counted where a path happens to meet an emitter.
struct BrdfSamples {
  explicit BrdfSamples(const IntegratorOptions&) {}
  static constexpr bool kSamplesLights = false;
  template <class LightPdf>
  static float brdf_weight(PdfSolidAngle, const LightPdf&) {
    return 1;
  }
  static Weighting weighting() { return Weighting::brdf; }
};

template <Model M>
using BrdfIntegrator = PathIntegrator<M, BrdfSamples>;

}  // namespace

std::unique_ptr<const Integrator> make_brdf(const Model& model, const IntegratorOptions& options) {
  return for_model<BrdfIntegrator>(model, options);
}

}  // namespace lemma
