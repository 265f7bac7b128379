#pragma once

#include <vector>

#include "integrators/integrator.h"
#include "src/shading/phong_wave.h"

namespace lemma {

/// How a Technique (path.h) weighs samples.
enum class Weighting {
  balance,  // by the balance heuristic
  power,    // by the power heuristic
  lights,   // light samples count alone
  brdf      // BRDF samples count alone
};

/// Light samples as reflected by the vertices of a wave.
struct ReflectedWave {
  Wave<std::uint32_t> reflects;  // 0: there is no sample, or it is not reflected
  RgbWave contribution;          // to the radiance of the path, if the light is seen
};

/// Paths that may go on.
struct ContinuedWave {
  Wave<std::uint32_t> alive;  // 0: absorbed, or ended by roulette
  Wave<float> survival;       // of roulette
};

/// How samples and paths are weighed, for the first `count` lanes of a wave, compiled for one instruction
/// set.
struct WeightStages {
  /// What light_sample() (emission.h) finds of a light that is seen.
  /// @param local  directions of the samples in the vertices' frames
  void (*light)(Weighting weighting, const LightSampleWave& samples, const BrdfValueWave& brdf,
                const VecWave& local, const RgbWave& throughput, std::size_t count, ReflectedWave& reflected);
  /// The weight of emitters met by BRDF samples of density pdf_brdf, where light samples have pdf_light; 1
  /// through glass, whose density is infinite.
  void (*emission)(Weighting weighting, const Wave<float>& pdf_brdf, const Wave<float>& pdf_light,
                   std::size_t count, Wave<float>& weight);
  /// Multiplies the throughput and finds the probability to go on; alive are lanes with a sample.
  void (*scatter)(Roulette roulette, int depth, const BrdfSampleWave& samples, std::size_t count,
                  RgbWave& throughput, ContinuedWave& continued);
  /// Plays roulette.
  /// @param u  uniform in [0, 1), where the survival is below 1
  void (*survive)(const Wave<float>& u, std::size_t count, RgbWave& throughput, ContinuedWave& continued);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the bits that single paths get.
[[nodiscard]] const std::vector<WeightStages>& all_weight_stages();

}  // namespace lemma
