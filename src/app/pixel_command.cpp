#include "src/app/pixel_command.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/app/argument_error.h"
#include "src/app/path_report.h"
#include "src/render/whole_file.h"

namespace lemma {
namespace {

void check_inside(const Pixel& pixel, const CameraView& view) {
  if (pixel.x < view.width && pixel.y < view.height) return;
  throw ArgumentError(
      fmt::format("--pixel: the image of {}x{} has no pixel {},{}", view.width, view.height, pixel.x,
                  pixel.y),
      fmt::format("expected X,Y from 0,0 (upper left) to {},{}", view.width - 1, view.height - 1));
}

std::vector<std::unique_ptr<const LightSampler>> all_strategies(const Scene& scene) {
  std::vector<std::unique_ptr<const LightSampler>> strategies;
  for (const auto& entry : light_samplers())
    strategies.push_back(entry.value(scene.emitters, scene.triangles));
  return strategies;
}

}  // namespace

void check_pixel_options(const RenderOptions& options) {
  if (!options.pixel) {
    if (!options.explain && options.explain_json.empty()) return;
    throw ArgumentError(fmt::format("{}: which pixel?", options.explain ? "--explain" : "--explain-json"),
                        "add --pixel X,Y; 0,0 is the upper left one");
  }
  if (options.outputs.empty() && options.stats.empty()) return;
  throw ArgumentError("--pixel writes no image and no figures", "leave out --output and --stats, or --pixel");
}

ExitCode run_pixel(const RenderOptions& options, const World& world, const Integrator& integrator) {
  check_inside(*options.pixel, world.scene.view);
  nlohmann::ordered_json samples = nlohmann::ordered_json::array();
  const auto tell = [&](const ExplainedSample& sample) {
    if (options.explain) fmt::print("{}", path_text(sample));
    if (!options.explain_json.empty()) samples.push_back(path_json(sample));
  };
  const auto strategies = all_strategies(world.scene);
  RenderSettings settings = options.settings;
  settings.spp = options.spp.value_or(settings.spp);
  const ExplainedPixel pixel =
      explain_pixel(world, integrator, settings, options.pixel->x, options.pixel->y, strategies, tell);
  if (!options.explain_json.empty()) {
    write_whole_file(options.explain_json, pixel_json(options, pixel, std::move(samples)));
  }
  fmt::print("pixel {},{}: radiance {:.9g} {:.9g} {:.9g}\n", options.pixel->x, options.pixel->y,
             pixel.radiance.r, pixel.radiance.g, pixel.radiance.b);
  if (pixel.invalid_samples > 0) fmt::print("invalid samples: {}, left out\n", pixel.invalid_samples);
  return pixel.invalid_samples > 0 ? kInvalidSamples : kDone;
}

}  // namespace lemma
