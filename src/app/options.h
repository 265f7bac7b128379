#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accel/accelerator.h"
#include "integrators/integrator.h"
#include "src/app/scene_options.h"
#include "src/render/render.h"
#include "src/render/tone_map.h"

namespace CLI {
class App;
}

namespace lemma {

enum class ProgressStyle { automatic, bar, plain, off };

/// A pixel of an image; 0, 0 is the upper left one.
struct Pixel {
  int x = 0, y = 0;
};

/// Everything `lemma render` can be told.
struct RenderOptions {
  SceneOptions scene;
  std::vector<std::filesystem::path> outputs;
  std::filesystem::path stats;  // empty: none
  Named<AcceleratorFactory> accel = accelerators().front();
  AcceleratorOptions accel_options;
  Named<IntegratorFactory> integrator = integrators().front();
  IntegratorOptions integrator_options;
  Named<LightSamplerFactory> lights = light_samplers().front();
  RenderSettings settings;
  std::optional<std::uint32_t> spp;         // in place of that of settings, which is the default
  std::optional<double> seconds;            // of rendering
  std::optional<double> target_relmse;      // at which rendering stops
  std::filesystem::path reference;          // image to measure the error against; empty: none
  std::optional<std::pair<int, int>> size;  // width, height in place of the scene's
  std::optional<Pixel> pixel;               // render this one alone
  bool explain = false;                     // tell what happens on its paths
  std::filesystem::path explain_json;       // the same as a file; empty: none
  int threads = 0;                          // 0: all
  ToneMap tone_map;
  ProgressStyle progress = ProgressStyle::automatic;
  bool quiet = false;  // nothing is printed but errors
};

/// Adds the command and binds its options to `options`.
CLI::App* add_render_command(CLI::App& app, RenderOptions& options);

}  // namespace lemma
