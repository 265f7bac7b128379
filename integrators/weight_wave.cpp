#include "integrators/weight_wave.h"

#include "src/core/instruction_sets.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "integrators/weight_wave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

// Plain loops without branches, that compilers turn into vector code of the instruction set.

/// Calls use(weigh) with the function of (own density, the other technique's) of a weighting; `counted` is
/// that of the technique alone whose samples are weighed.
template <class Use>
void with_weights(Weighting weighting, Weighting counted, const Use& use) {
  switch (weighting) {
    case Weighting::balance:
      return use([](PdfSolidAngle a, PdfSolidAngle b) { return balance_heuristic(a, b); });
    case Weighting::power:
      return use([](PdfSolidAngle a, PdfSolidAngle b) { return power_heuristic(a, b); });
    default: {
      const float weight = weighting == counted ? 1 : 0;
      return use([=](PdfSolidAngle, PdfSolidAngle) { return weight; });
    }
  }
}

void light(Weighting weighting, const LightSampleWave& samples, const BrdfValueWave& brdf,
           const VecWave& local, const RgbWave& throughput, std::size_t count, ReflectedWave& reflected) {
  with_weights(weighting, Weighting::lights, [&](const auto& weigh) {
    for (std::size_t i = 0; i < wave_end(count); ++i) {
      const Rgb f_cos = brdf.f[i] * std::max(local.z[i], 0.0f);
      const float pdf = samples.pdf[i], weight = weigh({pdf}, {brdf.pdf[i]});
      reflected.reflects[i] = (pdf > 0) & !is_black(f_cos) ? 1 : 0;
      reflected.contribution.set(i, throughput[i] * (f_cos * samples.radiance[i] * (weight / pdf)));
    }
  });
}

void emission(Weighting weighting, const Wave<float>& pdf_brdf, const Wave<float>& pdf_light,
              std::size_t count, Wave<float>& weight) {
  with_weights(weighting, Weighting::brdf, [&](const auto& weigh) {
    for (std::size_t i = 0; i < wave_end(count); ++i) {
      const float by_pdf = weigh({pdf_brdf[i]}, {pdf_light[i]});
      weight[i] = std::isinf(pdf_brdf[i]) ? 1.0f : by_pdf;
    }
  });
}

void scatter(Roulette roulette, int depth, const BrdfSampleWave& samples, std::size_t count,
             RgbWave& throughput, ContinuedWave& continued) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const Rgb now = throughput[i] * samples.weight[i];
    throughput.set(i, now);
    continued.survival[i] = survival(roulette, depth, now);
    continued.alive[i] = samples.pdf[i] > 0 ? 1 : 0;
  }
}

void survive(const Wave<float>& u, std::size_t count, RgbWave& throughput, ContinuedWave& continued) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const float q = continued.survival[i];
    const bool survives = (q == 1) | (u[i] < q);
    continued.alive[i] = survives ? continued.alive[i] : 0;
    throughput.set(i, throughput[i] * (1 / q));
  }
}

}  // namespace

WeightStages weight_stages() {
  return {light, emission, scatter, survive, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(weight_stages);

const std::vector<WeightStages>& all_weight_stages() {
  static const std::vector<WeightStages> all =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(weight_stages)(); });
  return all;
}

}  // namespace lemma
#endif
