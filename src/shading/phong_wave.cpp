#include "src/shading/phong_wave.h"

#include "src/core/instruction_sets.h"
#include "src/shading/phong_formulas.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/shading/phong_wave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

// Plain loops without branches, that compilers turn into vector code of the instruction set.

template <class Formulas>
void at(const MaterialWave& materials, const VecWave& wo, const VecWave& wi, std::size_t count,
        BrdfValueWave& values) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const BrdfValue value = Formulas::at(materials[i], wo[i], wi[i]);
    values.f.set(i, value.f);
    values.pdf[i] = value.pdf.value;
  }
}

template <class Formulas>
void sample(const MaterialWave& materials, const VecWave& wo, const ChoicePairWave& u, std::size_t count,
            BrdfSampleWave& samples) {
  // Apart: together, GCC joins what follows from the choice in both, to a flow that vector code cannot have.
  Wave<std::uint32_t> diffuse;
  Wave<float> x;
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const double p = materials.diffuse_probability[i];
    const bool first = u.x[i] < p;
    diffuse[i] = first ? 1 : 0;
    x[i] = rest_of_choice(u.x[i], p, first);
  }
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const Vec3 wi = Formulas::draw(materials[i], wo[i], diffuse[i] != 0, {x[i], u.y[i]});
    samples.wi.set(i, wi);
  }
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const BrdfSample sample = Formulas::weigh(materials[i], wo[i], samples.wi[i]);
    samples.pdf[i] = sample.pdf.value;
    samples.weight.set(i, sample.weight);
  }
}

template <class Formulas>
PhongWaves waves_of() {
  return {at<Formulas>, sample<Formulas>, hwy::TargetName(HWY_TARGET)};
}

}  // namespace

PhongWaves phong_waves(bool specular, Lobe lobe, LobeSampling sampling) {
  if (!specular) return waves_of<LambertFormulas>();
  if (lobe == Lobe::blinn_phong) return waves_of<MixtureFormulas<BlinnLobe>>();
  return sampling == LobeSampling::truncated ? waves_of<MixtureFormulas<PhongLobe<true>>>()
                                             : waves_of<MixtureFormulas<PhongLobe<false>>>();
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(phong_waves);

std::vector<PhongWaves> all_phong_waves(bool specular, Lobe lobe, LobeSampling sampling) {
  return for_every_instruction_set(
      [&] { return HWY_DYNAMIC_DISPATCH(phong_waves)(specular, lobe, sampling); });
}

}  // namespace lemma
#endif
