#include "tests/support/images.h"

#include <cstring>
#include <stdexcept>

namespace lemma::test {

Scene own_scene(std::string_view name, int width, int height) {
  Scene scene = load_scene(std::filesystem::path(LEMMA_SCENES) / name).scene;
  scene.view.width = width;
  scene.view.height = height;
  return scene;
}

RenderResult render_scene(const Scene& scene, const Configuration& c, const RenderSettings& settings) {
  const auto accel = find_named(accelerators(), c.accel).value()(scene.triangles, {});
  const auto lights = find_named(light_samplers(), c.lights).value()(scene.emitters, scene.triangles);
  const auto integrator = find_named(integrators(), c.integrator).value()(scene.needs.model, c.options);
  return render({scene, *accel, *lights}, *integrator, settings, nullptr);
}

double image_mean(const Image& image) {
  double sum = 0;
  for (const Rgb& c : image.pixels) sum += (static_cast<double>(c.r) + c.g + c.b) / 3;
  return sum / static_cast<double>(image.pixels.size());
}

Estimate mean_over_seeds(const Scene& scene, const Configuration& configuration, std::uint32_t spp,
                         std::uint64_t first_seed, int seeds) {
  std::vector<double> means;
  for (int i = 0; i < seeds; ++i) {
    const RenderResult result = render_scene(
        scene, configuration,
        {.spp = spp, .seed = first_seed + static_cast<std::uint64_t>(i), .sequence = configuration.sequence});
    if (result.invalid_samples > 0) throw std::runtime_error("a rendering met invalid samples");
    means.push_back(image_mean(result.image));
  }
  return estimate(means);
}

std::size_t differing_pixels(const Image& a, const Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (std::memcmp(&a.pixels[i], &b.pixels[i], sizeof(Rgb)) != 0) ++count;
  }
  return count;
}

}  // namespace lemma::test
