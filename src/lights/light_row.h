#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/lights/light_bounds.h"
#include "src/lights/light_sampler.h"
#include "src/lights/quad_light.h"
#include "src/lights/weigh_wholes.h"

namespace lemma {

/// The lights of a tree (light_tree.h) that has no levels above them, whole lights and quads: one choice
/// among all, which a wave can make step by step for all its lanes.
struct LightRow {
  struct Light {
    explicit Light(const LightImportance& of_node) : importance(of_node) {}

    // One of these two.
    const WholeLight* whole = nullptr;
    const QuadLight* quad = nullptr;
    LightImportance importance;  // of the light's node; a quad needs what is reflected
    WholeOutline outline;        // of a whole light, as is ...
    Rgb radiance;                // ... this
  };
  std::vector<Light> lights;
  bool is_single = false;  // the root is the light: it is chosen without a weight
  std::span<const Emitter> emitters;
  std::vector<std::uint32_t> light_of;  // by emitter, an index into `lights`
};

/// What is found on the way from a wave's points to their samples and densities.
struct LightRowScratch {
  Wave<double> weight[WholeBlock::kSize];  // of each light: a node has no more children
  Wave<double> sum, target, own;           // `own`: of the light chosen
  Wave<std::uint32_t> chosen;              // index of a light
  Wave<std::uint32_t> is_chosen;           // not 0 if one is
  Wave<double> pmf, u;                     // of the light; what the choice leaves of its number
  // Of the light chosen: of a whole one ...
  Wave<std::uint32_t> is_whole;
  Wave<double> centre_x, centre_y, centre_z, radius, core, shell;
  // ... and of a quad.
  Wave<std::uint32_t> half;
  VecWave half_v0, half_v1, half_v2;
  Wave<double> area_density;
  VecWave v0, v1, v2;                     // the emitter
  bool has_lobes[kWaveSize / kWaveStep];  // of each step: whether a lane reflects by one
  // Not 0: the lane is not done, but for single points to do.
  Wave<std::uint32_t> undone;
};

/// LightWaveSampler of a row, compiled for one instruction set: but for the lanes that are left undone, where
/// x is too near for one of the lights to be sampled as one.
struct LightRowWaves {
  void (*sample)(const LightRow& row, const LightQueryWave& at, std::size_t count, const ChoicePairWave& u,
                 LightRowScratch& scratch, LightSampleWave& samples);
  void (*pdf)(const LightRow& row, const LightQueryWave& at, std::size_t count,
              const Wave<std::uint32_t>& emitter, const VecWave& y, LightRowScratch& scratch,
              Wave<float>& pdf);
};

/// Of the instruction set that is chosen.
[[nodiscard]] LightRowWaves light_row_waves();

}  // namespace lemma
