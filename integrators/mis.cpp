#include "integrators/path.h"

namespace lemma {

std::unique_ptr<const Integrator> make_direct(const Model& model, const IntegratorOptions& options);
std::unique_ptr<const Integrator> make_brdf(const Model& model, const IntegratorOptions& options);

namespace {

/// The report's 7.3 as one path: light samples and BRDF samples, both weighted by a heuristic. The report
/// recursed into both samples, 2 x 0.6 = 1.2 new paths a vertex: in a closed scene that never ends.
class WeightedSamples {
 public:
  explicit WeightedSamples(const IntegratorOptions& options) : heuristic_(options.heuristic) {}
  static constexpr bool kSamplesLights = true;
  [[nodiscard]] float light_weight(PdfSolidAngle light, PdfSolidAngle brdf) const {
    return mis_weight(heuristic_, light, brdf);
  }
  template <class LightPdf>
  [[nodiscard]] float brdf_weight(PdfSolidAngle brdf, const LightPdf& light) const {
    return mis_weight(heuristic_, brdf, light());
  }
  [[nodiscard]] Weighting weighting() const {
    return heuristic_ == Heuristic::balance ? Weighting::balance : Weighting::power;
  }

 private:
  Heuristic heuristic_;
};

template <Model M>
using MisIntegrator = PathIntegrator<M, WeightedSamples>;

}  // namespace

std::unique_ptr<const Integrator> make_mis(const Model& model, const IntegratorOptions& options) {
  if (options.counted_samples == CountedSamples::light) return make_direct(model, options);
  if (options.counted_samples == CountedSamples::brdf) return make_brdf(model, options);
  return for_model<MisIntegrator>(model, options);
}

}  // namespace lemma
