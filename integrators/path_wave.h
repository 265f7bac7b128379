#pragma once

#include <vector>

#include "integrators/integrator.h"
#include "integrators/vertex_wave.h"
#include "integrators/weight_wave.h"
#include "src/core/lane_list.h"

namespace lemma {

/// Which model and technique of PathIntegrator (path.h) a wave follows.
struct WaveTechnique {
  IntegratorOptions options;
  Weighting weighting = Weighting::power;
  Model model;
};

/// Paths from the camera that are followed together, from vertex to vertex: what PathIntegrator does for
/// single ones, to the bit. Lanes that have no more light to bring are left out, so that the others lie side
/// by side.
class PathWave final : public WaveIntegrator {
 public:
  PathWave(const WaveTechnique& technique, const World& world);

  void radiances(const RayWave& rays, const HitWave& first, std::size_t count, Tracer& tracer,
                 const SamplerWave& random, RgbWave& radiance) override;

 private:
  void start(const RayWave& rays, const HitWave& first, std::size_t count, const SamplerWave& random);
  void split_hits();
  void add_emission(RgbWave& radiance);
  void weigh_emission();
  void pass_glass();
  void find_vertices();
  void set_material(std::size_t lane, const Material& material);
  void add_lights(Tracer& tracer, RgbWave& radiance);
  void sample_lights();
  void sample_lights_one_by_one();
  void trace_lights(Tracer& tracer, RgbWave& radiance);
  void trace_whole_lights(Tracer& tracer, RgbWave& radiance);
  void add_seen(std::size_t lane, RgbWave& radiance) {
    radiance.set(id_[lane], radiance[id_[lane]] + reflected_.contribution[lane]);
  }
  [[nodiscard]] bool is_uncovered(std::size_t lane) const;
  void keep_above(const VecWave& w, Wave<std::uint32_t>& lanes);
  void scatter();
  void go_on(Tracer& tracer);
  void go_on_from_glass();

  const WaveTechnique technique_;
  const World world_;
  const LightWaveSampler* const lights_;  // or null: lights are sampled one by one
  const PhongWaves phong_;
  const VertexStages vertex_stages_;
  const WeightStages weight_stages_;

  // The paths: ray, what it hits, and what was known where the ray started.
  std::size_t count_ = 0;
  int depth_ = 0;
  Wave<std::uint32_t> id_;  // lane of the camera ray
  RgbWave throughput_;
  SamplerWave random_;
  RayWave rays_;
  HitWave hits_;
  Wave<float> pdf_brdf_;
  VertexWave vertices_;

  LaneList emitters_, glass_, surfaces_, whole_, points_, alive_;

  // Paths that glass sends on, by themselves until those of the surfaces are found.
  struct GlassPath {
    std::uint32_t id;
    Rgb throughput;
    Sampler random;
    Ray ray;
  };
  std::vector<GlassPath> from_glass_;

  // What one stage tells the next.
  struct Emission {
    LightQueryWave from;
    Wave<std::uint32_t> emitter;
    VecWave y;
    Wave<float> pdf_brdf, pdf_light, weight;
  };
  Wave<std::uint32_t> emitter_;
  Emission emission_;
  TouchWave touches_;
  Wave<std::uint32_t> wanted_, above_;
  Wave<float> u_;
  ChoicePairWave pairs_;
  LightSampleWave samples_;
  VecWave local_, world_wi_;
  BrdfValueWave brdf_;
  ReflectedWave reflected_;
  RayWave shadow_rays_;
  HitWave shadow_hits_;
  Wave<std::uint8_t> blocked_;
  BrdfSampleWave scattered_;
  ContinuedWave continued_;
  std::vector<LightQuery> queries_;  // by id, where lights are sampled one by one
};

}  // namespace lemma
