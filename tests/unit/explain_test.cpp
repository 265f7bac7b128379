#include "src/render/explain.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "tests/support/images.h"

namespace lemma {
namespace {

bool same_bits(const Rgb& a, const Rgb& b) {
  return std::memcmp(&a, &b, sizeof(Rgb)) == 0;
}

/// The sum of what the events contribute, in their order. Events that contribute nothing add nothing.
Rgb sum_of_contributions(const std::vector<PathEvent>& events) {
  Rgb sum;
  for (const PathEvent& event : events) {
    if (const auto* light = std::get_if<LightEvent>(&event)) sum += light->contribution;
    if (const auto* emitter = std::get_if<EmitterEvent>(&event)) sum += emitter->contribution;
  }
  return sum;
}

/// What explains the pixels of an image, made once for all of them.
struct Rendering {
  Rendering(Scene s, const std::string& integrator_name, const IntegratorOptions& options)
      : scene(std::move(s)),
        accel(find_named(accelerators(), "embree").value()(scene.triangles, {})),
        lights(light_samplers().front().value(scene.emitters, scene.triangles)),
        integrator(find_named(integrators(), integrator_name).value()(scene.needs.model, options)) {
    for (const auto& entry : light_samplers())
      strategies.push_back(entry.value(scene.emitters, scene.triangles));
  }
  [[nodiscard]] World world() const { return {scene, *accel, *lights}; }

  Scene scene;
  std::unique_ptr<const Accelerator> accel;
  std::unique_ptr<const LightSampler> lights;
  std::unique_ptr<const Integrator> integrator;
  std::vector<std::unique_ptr<const LightSampler>> strategies;
};

/// Explained pixels are those of the image, bit for bit, and the contributions told are all there is.
void expect_same_pixels(const Rendering& rendering, const RenderSettings& settings) {
  const Image image = render(rendering.world(), *rendering.integrator, settings, nullptr).image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::uint32_t samples = 0;
      const auto check = [&](const ExplainedSample& sample) {
        EXPECT_EQ(sample.index, samples++);
        EXPECT_TRUE(same_bits(sum_of_contributions(sample.events), sample.radiance)) << x << "," << y;
      };
      const ExplainedPixel pixel = explain_pixel(rendering.world(), *rendering.integrator, settings, x, y,
                                                 rendering.strategies, check);
      ASSERT_EQ(samples, settings.spp);
      ASSERT_TRUE(same_bits(pixel.radiance, image.at(x, y))) << x << "," << y;
    }
  }
}

TEST(Explain, PixelsAreThoseOfTheImage) {
  for (const auto& integrator : integrators()) {
    for (const auto& sequence : sequences()) {
      for (const auto& roulette : roulettes()) {
        const RenderSettings settings{.spp = 3, .seed = 5, .sequence = sequence.value};
        const IntegratorOptions options{.roulette = roulette.value};
        for (const char* scene : {"cornell-coplanar", "veach-mis"}) {
          SCOPED_TRACE(std::string(scene) + ", " + std::string(integrator.name));
          // 20 wide: pixels of the second tile as well
          const Rendering rendering(test::own_scene(scene, 20, 7), std::string(integrator.name), options);
          expect_same_pixels(rendering, settings);
        }
      }
    }
  }
}

/// The density told for the light sampling in use is the one that a sample was drawn with, and the weights
/// are the heuristic of the densities told.
TEST(Explain, DensitiesAndWeightsBelongTogether) {
  const Rendering rendering(test::own_scene("veach-mis", 16, 9), "mis", {});
  std::size_t lights = 0, emitters = 0;
  const auto check = [&](const ExplainedSample& sample) {
    for (const PathEvent& event : sample.events) {
      if (const auto* light = std::get_if<LightEvent>(&event); light && light->fate == LightFate::seen) {
        ++lights;
        ASSERT_EQ(light->densities.light.size(), light_samplers().size());
        // The point is rounded to float before the density is asked for again.
        EXPECT_NEAR(light->densities.light.front() / light->pdf, 1, 1e-3);
        EXPECT_FLOAT_EQ(light->weight, power_heuristic({light->pdf}, {light->densities.brdf}));
      }
      if (const auto* emitter = std::get_if<EmitterEvent>(&event);
          emitter && !emitter->densities.light.empty()) {
        ++emitters;
        EXPECT_FLOAT_EQ(emitter->weight,
                        power_heuristic({emitter->densities.brdf}, {emitter->densities.light.front()}));
      }
    }
  };
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 9; ++y) {
      const ExplainedPixel pixel = explain_pixel(rendering.world(), *rendering.integrator, {.spp = 16}, x, y,
                                                 rendering.strategies, check);
      EXPECT_EQ(pixel.invalid_samples, 0u);
    }
  }
  EXPECT_GT(lights, 400u);
  EXPECT_GT(emitters, 40u);
}

}  // namespace
}  // namespace lemma
