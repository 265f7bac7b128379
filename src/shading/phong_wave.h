#pragma once

#include <vector>

#include "src/core/sampler_wave.h"
#include "src/core/wave.h"
#include "src/shading/phong.h"

namespace lemma {

/// What Phong needs of the material of each lane. Lobe and LobeSampling are the same for all lanes.
struct MaterialWave {
  RgbWave kd, ks;
  Wave<float> exponent, specular_factor, diffuse_probability;

  void set(std::size_t lane, const Material& m) {
    kd.set(lane, m.kd), ks.set(lane, m.ks);
    exponent[lane] = m.exponent, specular_factor[lane] = m.specular_factor,
    diffuse_probability[lane] = m.diffuse_probability;
  }
  /// That much of it.
  [[nodiscard]] Material operator[](std::size_t lane) const {
    return {.kd = kd[lane],
            .ks = ks[lane],
            .exponent = exponent[lane],
            .specular_factor = specular_factor[lane],
            .diffuse_probability = diffuse_probability[lane]};
  }
};

/// BrdfValue of each lane.
struct BrdfValueWave {
  RgbWave f;
  Wave<float> pdf;
};

/// BrdfSample of each lane; pdf 0: there is none, and the rest means nothing.
struct BrdfSampleWave {
  VecWave wi;
  Wave<float> pdf;
  RgbWave weight;
};

/// Phong<> for the first `count` lanes of a wave, compiled for one instruction set.
struct PhongWaves {
  void (*at)(const MaterialWave& materials, const VecWave& wo, const VecWave& wi, std::size_t count,
             BrdfValueWave& values);
  void (*sample)(const MaterialWave& materials, const VecWave& wo, const ChoicePairWave& u, std::size_t count,
                 BrdfSampleWave& samples);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the bits that Phong gives for single
/// directions.
/// @param specular  false: no lane has ks > 0; sample() then takes u.x as float, as Phong<false> does
[[nodiscard]] std::vector<PhongWaves> all_phong_waves(bool specular, Lobe lobe, LobeSampling sampling);

}  // namespace lemma
