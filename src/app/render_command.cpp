#include "src/app/render_command.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "src/app/progress.h"
#include "src/app/summary.h"
#include "src/core/parallel.h"
#include "src/render/image_file.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

/// The image to write when none is named: the scene's name, in this folder.
fs::path default_output(const LoadReport& report) {
  return report.obj.stem().string() + ".exr";
}

LoadedScene load(const RenderOptions& options) {
  LoadedScene loaded = load_scene(options.scene, options.load);
  if (options.size) std::tie(loaded.scene.view.width, loaded.scene.view.height) = *options.size;
  if (options.progress != ProgressStyle::off) fmt::print(stderr, "{}\n", describe(loaded));
  for (const std::string& warning : loaded.report.warnings) fmt::print(stderr, "{}\n", warning);
  return loaded;
}

/// The options that the image depends on, as a command line would say them.
std::string image_options(const RenderOptions& o) {
  const IntegratorOptions& i = o.integrator_options;
  std::string_view roulette;
  for (const auto& entry : roulettes()) {
    if (entry.value == i.roulette) roulette = entry.name;
  }
  return fmt::format(
      "--accel {} --integrator {} --lights {} --rr {} --max-depth {} --phong-norm {} --emitters {} --spp {} "
      "--seed {}",
      o.accel.name, o.integrator.name, o.lights.name, roulette, i.max_depth,
      o.load.phong_norm == PhongNorm::n_plus_1 ? "n+1" : "n+2", i.emitters_reflect ? "reflect" : "absorb",
      o.settings.spp, o.settings.seed);
}

Metadata image_metadata(const RenderOptions& options) {
  return {{"Software", "Lemma " LEMMA_VERSION},
          {"lemma:version", LEMMA_VERSION},
          {"lemma:scene", options.scene.string()},
          {"lemma:options", image_options(options)},
          {"lemma:spp", fmt::format("{}", options.settings.spp)},
          {"lemma:seed", fmt::format("{}", options.settings.seed)}};
}

void write_stats(const fs::path& path, const std::string& json) {
  if (path.empty()) return;
  std::ofstream file(path);
  file << json;
  if (!file.flush()) throw ImageFileError(fmt::format("{}: error: cannot be written", path.string()));
}

struct BuiltAccelerator {
  std::unique_ptr<const Accelerator> accel;
  double seconds;
};

BuiltAccelerator build_accelerator(const RenderOptions& options, const Scene& scene) {
  const auto start = std::chrono::steady_clock::now();
  auto accel = options.accel.value(scene.triangles, options.accel_options);
  return {std::move(accel), std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace

ExitCode run_render(const RenderOptions& options) {
  const ThreadLimit limit(options.threads);
  const LoadedScene loaded = load(options);
  const Scene& scene = loaded.scene;
  const std::vector<fs::path> outputs =
      options.outputs.empty() ? std::vector<fs::path>{default_output(loaded.report)} : options.outputs;
  for (const fs::path& path : outputs) check_writable(path);

  const BuiltAccelerator built = build_accelerator(options, scene);
  const auto lights = options.lights.value(scene.emitters);
  const auto integrator = options.integrator.value(scene.needs.model, options.integrator_options);
  Progress progress(options.progress);
  const RenderResult result = render({scene, *built.accel, *lights}, *integrator, options.settings,
                                     [&](double done) { progress.update(done); });

  for (const fs::path& path : outputs)
    write_image(path, result.image, options.tone_map, image_metadata(options));
  const RunFigures figures{describe(scene.needs), built.accel->description(), built.accel->memory_bytes(),
                           built.seconds, limit.threads()};
  write_stats(options.stats, summary_json(options, figures, result));
  if (options.progress != ProgressStyle::off) fmt::print("{}", summary_text(options, figures, result));
  return result.invalid_samples > 0 ? kInvalidSamples : kDone;
}

}  // namespace lemma
