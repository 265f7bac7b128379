#include "src/shading/phong_wave.h"

#include <type_traits>

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

// Plain loops over the lanes of a step without branches, that compilers turn into vector code of the
// instruction set.

/// Whether the lanes of a step from `begin` on reflect diffusely alone, for which LambertFormulas has the
/// bits of all others: in most scenes most steps do.
bool is_lambert(const MaterialWave& materials, std::size_t begin) {
  std::uint32_t lobes = 0;
  for (std::size_t i = begin; i < begin + kWaveStep; ++i)
    lobes |= !is_black(materials.ks[i]) | (materials.diffuse_probability[i] != 1) ? 1u : 0u;
  return lobes == 0;
}

/// Calls use(formulas, begin) for all steps with those that they need.
template <class Formulas, class Use>
void for_steps(const MaterialWave& materials, std::size_t count, const Use& use) {
  for (std::size_t begin = 0; begin < count; begin += kWaveStep) {
    if constexpr (!std::is_same_v<Formulas, LambertFormulas>) {
      if (!is_lambert(materials, begin)) {
        use(Formulas(), begin);
        continue;
      }
    }
    use(LambertFormulas(), begin);
  }
}

template <class Formulas>
void at_step(const MaterialWave& materials, const VecWave& wo, const VecWave& wi, std::size_t begin,
             BrdfValueWave& values) {
  for (std::size_t i = begin; i < begin + kWaveStep; ++i) {
    const BrdfValue value = Formulas::at(materials[i], wo[i], wi[i]);
    values.f.set(i, value.f);
    values.pdf[i] = value.pdf.value;
  }
}

template <class Formulas>
void at(const MaterialWave& materials, const VecWave& wo, const VecWave& wi, std::size_t count,
        BrdfValueWave& values) {
  for_steps<Formulas>(materials, count, [&]<class Needed>(Needed, std::size_t begin) {
    at_step<Needed>(materials, wo, wi, begin, values);
  });
}

template <class Formulas>
void sample_step(const MaterialWave& materials, const VecWave& wo, const ChoicePairWave& u, std::size_t begin,
                 BrdfSampleWave& samples) {
  // Apart: together, GCC joins what follows from the choice in both, to a flow that vector code cannot have.
  alignas(64) std::uint32_t diffuse[kWaveStep];
  alignas(64) float x[kWaveStep];
  for (std::size_t k = 0; k < kWaveStep; ++k) {
    const std::size_t i = begin + k;
    const double p = materials.diffuse_probability[i];
    const bool first = u.x[i] < p;
    diffuse[k] = first ? 1 : 0;
    x[k] = rest_of_choice(u.x[i], p, first);
  }
  for (std::size_t k = 0; k < kWaveStep; ++k) {
    const std::size_t i = begin + k;
    const Vec3 wi = Formulas::draw(materials[i], wo[i], diffuse[k] != 0, {x[k], u.y[i]});
    samples.wi.set(i, wi);
  }
  for (std::size_t i = begin; i < begin + kWaveStep; ++i) {
    const BrdfSample sample = Formulas::weigh(materials[i], wo[i], samples.wi[i]);
    samples.pdf[i] = sample.pdf.value;
    samples.weight.set(i, sample.weight);
  }
}

template <class Formulas>
void sample(const MaterialWave& materials, const VecWave& wo, const ChoicePairWave& u, std::size_t count,
            BrdfSampleWave& samples) {
  for_steps<Formulas>(materials, count, [&]<class Needed>(Needed, std::size_t begin) {
    sample_step<Needed>(materials, wo, u, begin, samples);
  });
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
