#include "src/app/render_command.h"

#include <fmt/format.h>

#include <chrono>
#include <tuple>

#include "src/app/argument_error.h"
#include "src/app/pixel_command.h"
#include "src/app/progress.h"
#include "src/app/render_passes.h"
#include "src/app/summary.h"
#include "src/app/unused_options.h"
#include "src/core/machine.h"
#include "src/core/parallel.h"
#include "src/render/image_file.h"
#include "src/render/image_layers.h"
#include "src/render/whole_file.h"
#include "src/scene/albedo.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

/// The image to write when none is named: the scene's name, in this folder.
fs::path default_output(const LoadReport& report) {
  return report.obj.stem().string() + ".exr";
}

/// Checks all files that are to be written and whose names are known without the scene.
void check_outputs(const RenderOptions& options) {
  check_pixel_options(options);
  for (const fs::path& path : options.outputs) check_writable(path);
  if (!options.stats.empty()) check_whole_file(options.stats);
  if (!options.explain_json.empty()) check_whole_file(options.explain_json);
}

/// What the options make of the scene that may surprise.
void warn_of_options(const RenderOptions& options, LoadedScene& loaded) {
  const IntegratorOptions& i = options.integrator_options;
  const float albedo = largest_albedo(loaded.scene, i.emitters_reflect);
  const bool two_samples = options.integrator.name == "mis-report";
  const float spread = two_samples ? kTwoSampleSpread : kOneSampleSpread;
  if (!has_infinite_variance(i.roulette, albedo, spread)) return;
  warn(loaded.report.warnings, {loaded.report.xml},
       fmt::format(
           "--rr {}: surfaces reflect up to {:.3g} of the light, whose square{} is not below {:.1f}: the "
           "variance {} infinite where paths cannot leave; --rr throughput has no such limit",
           name_of(roulettes(), i.roulette), albedo,
           two_samples ? " times the 1.5 of mis-report's two samples" : "", kFixedSurvival,
           two_samples ? "can be" : "is"));
}

/// A reference with the random numbers of the image has errors of its own that are not independent of the
/// image's: the errors told would be too small, down to 0 at its own number of samples.
void warn_of_reference(const RenderOptions& options, const ReadImage& reference) {
  if (options.quiet || reference.seed != std::to_string(options.settings.seed)) return;
  Warnings warnings;
  warn(warnings, {options.reference},
       fmt::format("it was rendered with --seed {}, too: the errors told will be too small; render with "
                   "another seed than the reference's",
                   reference.seed));
  report_warnings(warnings, false);
}

/// Memory of a pixel, beside the film, while an image is rendered and encoded: colours and variances as
/// float, as written, and once more in the encoder [bytes].
constexpr std::uint64_t kBytesAPixel = 72;

/// Refuses images that the machine cannot hold, before memory is taken for them.
void require_memory(const CameraView& view, std::uint32_t film_parts) {
  const std::uint64_t needed = (kBytesAPixel + Film::bytes_a_pixel(film_parts)) *
                               static_cast<std::uint64_t>(view.width) *
                               static_cast<std::uint64_t>(view.height);
  if (needed <= machine_memory()) return;
  throw ArgumentError(
      fmt::format("an image of {}x{} needs {:.0f} GB of memory; there are {:.0f} GB", view.width, view.height,
                  static_cast<double>(needed) / 1e9, static_cast<double>(machine_memory()) / 1e9),
      "choose a smaller one with --size");
}

LoadedScene load(const RenderOptions& options) {
  LoadedScene loaded = load_scene(options.scene.scene, options.scene.load);
  if (options.size) std::tie(loaded.scene.view.width, loaded.scene.view.height) = *options.size;
  require_memory(loaded.scene.view, options.settings.film_parts());
  warn_of_options(options, loaded);
  if (!options.quiet) fmt::print(stderr, "{}\n", describe(loaded));
  if (!options.quiet || options.scene.strict) report_warnings(loaded.report.warnings, options.scene.strict);
  return loaded;
}

/// The options that the image depends on, as a command line would say them; those that ask for a time or an
/// error, as the samples that came of them.
std::string image_options(const RenderOptions& o, const CameraView& view, std::uint32_t spp) {
  const IntegratorOptions& i = o.integrator_options;
  return fmt::format(
      "--accel {} --integrator {} --lights {} --mis {} --technique {} --rr {} --max-depth {} {} "
      "--emitters {} --sampler {} --replicates {} --spp {} --seed {} --size {}x{}",
      o.accel.name, o.integrator.name, o.lights.name, name_of(heuristics(), i.heuristic),
      name_of(counted_samples(), i.counted_samples), name_of(roulettes(), i.roulette), i.max_depth,
      text_of(o.scene.load), i.emitters_reflect ? "reflect" : "absorb",
      name_of(sequences(), o.settings.sequence), o.settings.replicates, spp, o.settings.seed, view.width,
      view.height);
}

/// Nothing of it depends on when, where, or on how many threads the image was made: same input, same bytes.
Metadata image_metadata(const RenderOptions& options, const CameraView& view, const RenderResult& result) {
  return {{"Software", "Lemma " LEMMA_VERSION},
          {"DateTime", ""},  // else OpenImageIO puts the time there
          {"lemma:version", LEMMA_VERSION},
          {"lemma:scene", options.scene.scene.string()},
          {"lemma:options", image_options(options, view, result.spp)},
          {"lemma:spp", fmt::format("{}", result.spp)},
          {kSeedAttribute, fmt::format("{}", options.settings.seed)},
          {kPartsAttribute, fmt::format("{}", result.parts)}};
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
  check_outputs(options);
  if (!options.quiet) report_warnings(unused_options(options), false);
  const ThreadLimit limit(options.threads);
  const LoadedScene loaded = load(options);
  const Scene& scene = loaded.scene;
  std::vector<fs::path> outputs = options.outputs;
  if (outputs.empty() && !options.pixel) {
    check_writable(outputs.emplace_back(default_output(loaded.report)));
  }

  const std::optional<ReadImage> reference = read_reference(options, scene.view);
  if (reference) warn_of_reference(options, *reference);

  const BuiltAccelerator built = build_accelerator(options, scene);
  const auto lights = options.lights.value(scene.emitters, scene.triangles);
  const auto integrator = options.integrator.value(scene.needs.model, options.integrator_options);
  if (options.pixel) return run_pixel(options, {scene, *built.accel, *lights}, *integrator);
  Progress progress(options.quiet ? ProgressStyle::off : options.progress);
  const PassesResult passes =
      render_passes({scene, *built.accel, *lights}, *integrator, options, reference, progress);
  const RenderResult& result = passes.result;

  const Metadata metadata = image_metadata(options, scene.view, result);
  const Image* const variance = result.spp > 1 ? &result.variance : nullptr;
  for (const fs::path& path : outputs) write_image(path, result.image, variance, options.tone_map, metadata);
  const RunFigures figures{.model = describe(scene.needs),
                           .accelerator = built.accel->description(),
                           .accelerator_bytes = built.accel->memory_bytes(),
                           .accel_build_seconds = built.seconds,
                           .threads = limit.threads(),
                           .error = estimated_error(result.image, result.variance),
                           .curve = passes.curve,
                           .reference_noise = passes.reference_noise,
                           .target_reached = passes.target_reached};
  if (!options.stats.empty()) write_whole_file(options.stats, summary_json(options, figures, result));
  if (!options.quiet) fmt::print("{}", summary_text(options, figures, result));
  return result.invalid_samples > 0 ? kInvalidSamples : kDone;
}

}  // namespace lemma
