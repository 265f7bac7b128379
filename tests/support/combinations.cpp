#include "tests/support/combinations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

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

/// BRDF sampling is a choice of Phong's lobe alone.
bool has_phong_lobe(const Scene& scene) {
  return scene.needs.model.specular &&
         std::ranges::any_of(scene.materials, [](const Material& m) { return m.lobe == Lobe::phong; });
}

/// What is chosen of these options, as one number.
std::size_t number_of(const Combination& c, std::initializer_list<std::size_t> chosen_options) {
  std::size_t number = 0;
  for (const std::size_t o : chosen_options) number = number * options()[o].choices.size() + c[o];
  return number;
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
  if (!has_phong_lobe(scene) && c[kBrdfSampling] != 0) return false;
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
  if (kAllWeights[c[kWeights]].integrator == "brdf") return 0.5;
  return 1 + (lights == "solid-angle" ? emitters / 400 : lights == "projected" ? emitters / 350 : 0);
}

std::size_t kind_of_noise(const Combination& c) {
  return number_of(c, {kWeights, kLights, kRoulette, kSampler});
}

std::size_t family_of_noise(const Combination& c) {
  return number_of(c, {kWeights, kLights});
}

std::vector<std::vector<std::size_t>> blocks_of(int width, int height, int block) {
  std::vector<std::vector<std::size_t>> blocks;
  for (int top = 0; top < height; top += block) {
    for (int left = 0; left < width; left += block) {
      std::vector<std::size_t>& pixels = blocks.emplace_back();
      for (int y = top; y < std::min(top + block, height); ++y) {
        for (int x = left; x < std::min(left + block, width); ++x) {
          pixels.push_back(static_cast<std::size_t>(y * width + x));
        }
      }
    }
  }
  return blocks;
}

CombinationRenderer::CombinationRenderer(const Scene& scene) {
  for (const auto& sampling : lobe_samplings()) {
    scenes_.push_back(scene);
    for (Material& m : scenes_.back().materials) m.sampling = sampling.value;
  }
  for (const auto& strategy : light_samplers())
    lights_.push_back(strategy.value(scenes_[0].emitters, scene.triangles));
  for (const std::string_view name : options()[kAccelerator].choices) {
    accelerators_.push_back(find_named(accelerators(), name).value()(scenes_[0].triangles, {}));
  }
}

std::vector<double> CombinationRenderer::pixels(const Combination& c, std::uint32_t spp,
                                                std::uint64_t seed) const {
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
  std::vector<double> means;
  for (const Rgb& p : result.image.pixels) means.push_back((static_cast<double>(p.r) + p.g + p.b) / 3);
  return means;
}

}  // namespace lemma::test
