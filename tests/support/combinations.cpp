#include "tests/support/combinations.h"

#include <gtest/gtest.h>

namespace lemma::test {
namespace {

enum : std::size_t { kWeights, kLights, kBrdfSampling, kRoulette, kSampler, kAccelerator };

struct Weights {
  std::string_view name, integrator;
  Heuristic heuristic = Heuristic::power;
};

constexpr Weights kAllWeights[] = {{"mis", "mis"},
                                   {"mis, balance heuristic", "mis", Heuristic::balance},
                                   {"direct", "direct"},
                                   {"brdf", "brdf"},
                                   {"mis-report", "mis-report"},
                                   {"mis-report, balance heuristic", "mis-report", Heuristic::balance}};

template <class Table>
std::vector<std::string_view> names(const Table& table) {
  std::vector<std::string_view> found;
  for (const auto& entry : table) found.push_back(entry.name);
  return found;
}

std::string_view chosen(const Combination& c, std::size_t option) {
  return options()[option].choices[c[option]];
}

}  // namespace

std::span<const Option, kOptions> options() {
  static const std::array<Option, kOptions> table{{
      {"weights", names(kAllWeights)},
      {"lights", names(light_samplers())},
      {"BRDF sampling", names(lobe_samplings())},
      {"roulette", names(roulettes())},
      {"sampler", names(sequences())},
      {"accelerator", {"embree", "grid"}},
  }};
  return table;
}

Combination with(Combination combination, const Choice& choice) {
  combination[choice.option] = choice.index;
  return combination;
}

std::string name_of(const Choice& choice) {
  const Option& option = options()[choice.option];
  return std::string(option.name) + " " + std::string(option.choices[choice.index]);
}

std::string name_of(const Combination& combination) {
  std::string name;
  for (std::size_t o = 0; o < kOptions; ++o) {
    name.append(o == 0 ? "" : "; ").append(chosen(combination, o));
  }
  return name;
}

bool is_possible(const Combination& c, const Scene& scene, bool touches_light) {
  const std::string_view integrator = kAllWeights[c[kWeights]].integrator, lights = chosen(c, kLights);
  if (integrator == "brdf" && c[kLights] != 0) return false;
  if (!scene.needs.model.specular && c[kBrdfSampling] != 0) return false;
  const bool by_area = lights == "power" || lights == "radiance-area";
  return !(touches_light && integrator == "direct" && by_area);
}

std::vector<Combination> all_combinations(const Scene& scene, bool touches_light) {
  std::vector<Combination> found;
  Combination c{};
  const auto choose = [&](const auto& self, std::size_t option) -> void {
    if (option == kOptions) {
      if (is_possible(c, scene, touches_light)) found.push_back(c);
      return;
    }
    for (c[option] = 0; c[option] < options()[option].choices.size(); ++c[option]) self(self, option + 1);
  };
  choose(choose, 0);
  return found;
}

double cost(const Combination& c, const Scene& scene) {
  const std::string_view lights = chosen(c, kLights);
  const auto emitters = static_cast<double>(scene.emitters.size());
  return 1 + (lights == "solid-angle" ? emitters / 300 : lights == "projected" ? emitters / 100 : 0);
}

bool alike_in_noise(const Combination& a, const Combination& b) {
  return a[kWeights] == b[kWeights] && a[kLights] == b[kLights];
}

CombinationRenderer::CombinationRenderer(const Scene& scene) {
  for (const auto& sampling : lobe_samplings()) {
    scenes_.push_back(scene);
    for (Material& m : scenes_.back().materials) m.sampling = sampling.value;
  }
  for (const auto& strategy : light_samplers()) lights_.push_back(strategy.value(scenes_[0].emitters));
  for (const std::string_view name : options()[kAccelerator].choices) {
    accelerators_.push_back(find_named(accelerators(), name).value()(scenes_[0].triangles, {}));
  }
}

std::vector<double> CombinationRenderer::means(const Combination& c, std::uint32_t spp, std::uint64_t seed,
                                               int block) const {
  const Scene& scene = scenes_[c[kBrdfSampling]];
  const Weights& weights = kAllWeights[c[kWeights]];
  IntegratorOptions integrator_options;
  integrator_options.heuristic = weights.heuristic;
  integrator_options.roulette = roulettes()[c[kRoulette]].value;
  const auto integrator =
      find_named(integrators(), weights.integrator).value()(scene.needs.model, integrator_options);
  const RenderResult result =
      render({scene, *accelerators_[c[kAccelerator]], *lights_[c[kLights]]}, *integrator,
             {.spp = spp, .seed = seed, .sequence = sequences()[c[kSampler]].value}, nullptr);
  EXPECT_EQ(result.invalid_samples, 0u) << name_of(c);
  std::vector<double> means = block_means(result.image, block);
  means.insert(means.begin(), image_mean(result.image));
  return means;
}

}  // namespace lemma::test
