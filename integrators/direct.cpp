#include "integrators/path.h"

namespace lemma {
namespace {

/// The report's 7.1 and its Lemma 1: direct light by light samples alone; the path goes on by BRDF samples
/// for indirect light, and emitters that it meets count 0, for they were counted before.
struct LightSamples {
  explicit LightSamples(const IntegratorOptions&) {}
  static constexpr bool kSamplesLights = true;
  static float light_weight(PdfSolidAngle, PdfSolidAngle) { return 1; }
  template <class LightPdf>
  static float brdf_weight(PdfSolidAngle, const LightPdf&) {
    return 0;
  }
  static Weighting weighting() { return Weighting::lights; }
};

template <Model M>
using DirectIntegrator = PathIntegrator<M, LightSamples>;

}  // namespace

std::unique_ptr<const Integrator> make_direct(const Model& model, const IntegratorOptions& options) {
  return for_model<DirectIntegrator>(model, options);
}

}  // namespace lemma
