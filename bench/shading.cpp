// How fast the BRDF's values and samples are found for waves, by every instruction set, and for single
// directions: <at or sample>/<lobe>/<instruction set or single>, in lanes a second.
//   shading [Google Benchmark's options]
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "src/shading/phong_wave.h"

namespace lemma::bench {
namespace {

/// A full wave, exponents from 1 to 2048 and a third of the lanes without ks, as waves and lane by lane.
struct Input {
  std::vector<Material> material;
  MaterialWave materials;
  VecWave wo, wi;
  ChoicePairWave u;

  explicit Input(const BrdfOptions& options) {
    Sampler random(1, 0, 0);
    for (std::size_t i = 0; i < kWaveSize; ++i) {
      const float ks = i % 3 == 0 ? 0.0f : 0.5f, exponent = static_cast<float>(1 << i % 12);
      material.push_back(make_material({0.3f, 0.3f, 0.3f}, {ks, ks, ks}, exponent, options));
      materials.set(i, material.back());
      wo.set(i, cosine_hemisphere(random.next_2d()));
      wi.set(i, cosine_hemisphere(random.next_2d()));
      const Sampler::ChoicePair pair = random.next_choice_pair();
      u.x[i] = pair.x, u.y[i] = pair.y;
    }
  }
};

/// Benchmarks call(), which goes through a full wave.
template <class Call>
void add(const std::string& name, const Call& call) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    for (auto _ : state) {
      call();
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kWaveSize));
  });
}

void add_single(const std::string& lobe, const std::shared_ptr<const Input>& in) {
  add("at/" + lobe + "/single", [in] {
    for (std::size_t i = 0; i < kWaveSize; ++i)
      benchmark::DoNotOptimize(Phong<true>(in->material[i]).at(in->wo[i], in->wi[i]));
  });
  add("sample/" + lobe + "/single", [in] {
    for (std::size_t i = 0; i < kWaveSize; ++i) {
      const Sampler::ChoicePair u{in->u.x[i], in->u.y[i]};
      benchmark::DoNotOptimize(Phong<true>(in->material[i]).sample(in->wo[i], u));
    }
  });
}

void add_waves(const std::string& lobe, const std::shared_ptr<const Input>& in, const PhongWaves& waves) {
  const auto values = std::make_shared<BrdfValueWave>();
  add("at/" + lobe + "/" + waves.name, [=] { waves.at(in->materials, in->wo, in->wi, kWaveSize, *values); });
  const auto samples = std::make_shared<BrdfSampleWave>();
  add("sample/" + lobe + "/" + waves.name,
      [=] { waves.sample(in->materials, in->wo, in->u, kWaveSize, *samples); });
}

void add_all(const std::string& lobe, const BrdfOptions& options) {
  const auto in = std::make_shared<const Input>(options);
  for (const PhongWaves& waves : all_phong_waves(true, options.lobe, options.sampling))
    add_waves(lobe, in, waves);
  add_single(lobe, in);
}

}  // namespace
}  // namespace lemma::bench

int main(int argc, char** argv) {
  using lemma::bench::add_all;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  add_all("truncated", {});
  add_all("p6", {.sampling = lemma::LobeSampling::p6});
  add_all("blinn-phong", {.lobe = lemma::Lobe::blinn_phong});
  benchmark::RunSpecifiedBenchmarks();
}
