#include "src/app/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "src/app/number_option.h"
#include "src/app/progress.h"

namespace lemma {
namespace {

constexpr int kLargestEdge = 65536;  // of an image [pixels]
constexpr std::size_t kMostCells = std::size_t{1} << 28;

/// Adds an option that takes a finite number above `above`.
void add_real(CLI::App& app, const std::string& flag, float& value, float above, const std::string& help) {
  const auto parse = [=](const std::string& text) {
    const std::optional<float> number = parse_number<float>(text);
    return number && std::isfinite(*number) && *number > above ? number : std::nullopt;
  };
  add_value(app,
            {.flag = flag,
             .type = "X",
             .fallback = fmt::format("{}", value),
             .expected = std::isfinite(above) ? fmt::format("a number above {}", above) : "a number",
             .help = help},
            into(value, parse));
}

/// "12,7" with the separator ',' -> 12, 7.
std::optional<std::pair<int, int>> parse_pair(const std::string& text, char separator) {
  const auto middle = text.find(separator);
  if (middle == std::string::npos) return std::nullopt;
  const auto first = parse_number<int>(text.substr(0, middle));
  const auto second = parse_number<int>(text.substr(middle + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

/// "1280x720" -> width, height.
std::optional<std::pair<int, int>> parse_size(const std::string& text) {
  const auto size = parse_pair(text, 'x');
  const auto possible = [](int edge) { return edge >= 1 && edge <= kLargestEdge; };
  return size && possible(size->first) && possible(size->second) ? size : std::nullopt;
}

/// "12,7" -> pixel.
std::optional<Pixel> parse_pixel(const std::string& text) {
  const auto at = parse_pair(text, ',');
  if (!at || at->first < 0 || at->second < 0) return std::nullopt;
  return Pixel{at->first, at->second};
}

std::optional<GridResolution> parse_grid_cells(const std::string& text) {
  if (text == "density") return GridResolution{GridResolution::Rule::density};
  if (text == "27n") return GridResolution{GridResolution::Rule::twenty_seven};
  const auto cells = parse_number<std::size_t>(text);
  if (!cells || *cells < 1 || *cells > kMostCells) return std::nullopt;
  return GridResolution{.cells = *cells};
}

void add_transport_options(CLI::App& app, RenderOptions& o) {
  static constexpr Named<bool> emitters[] = {
      {"absorb", false, "paths end at emitters (the report's rule)"},
      {"reflect", true, "emitters also reflect, as their materials say"}};
  add_choice(
      app, "--integrator", integrators(), [&o](auto& entry) { o.integrator = entry; },
      "How light is estimated");
  add_choice(
      app, "--lights", light_samplers(), [&o](auto& entry) { o.lights = entry; },
      "How points on lights are chosen");
  add_choice(
      app, "--mis", heuristics(), [&o](auto& entry) { o.integrator_options.heuristic = entry.value; },
      "Weights of --integrator mis and mis-report");
  add_choice(
      app, "--technique", counted_samples(),
      [&o](auto& entry) { o.integrator_options.counted_samples = entry.value; },
      "Samples that --integrator mis counts");
  add_choice(
      app, "--rr", roulettes(), [&o](auto& entry) { o.integrator_options.roulette = entry.value; },
      "Russian roulette");
  add_integer(
      app, "--max-depth", o.integrator_options.max_depth, 0, IntegratorOptions::kLastResortDepth,
      "Scattering events on a path at most; 1 is direct light. Paths cut are counted: they make a bias");
  add_choice(
      app, "--emitters", std::span<const Named<bool>>(emitters),
      [&o](auto& entry) { o.integrator_options.emitters_reflect = entry.value; },
      "What emitters do besides emitting");
}

void add_accelerator_options(CLI::App& app, RenderOptions& o) {
  add_choice(
      app, "--accel", accelerators(), [&o](auto& entry) { o.accel = entry; },
      "What finds the triangle a ray hits");
  add_value(app,
            {.flag = "--grid-cells",
             .type = "density|27n|N",
             .fallback = "density",
             .expected = fmt::format("one of: density, 27n, or a whole number from 1 to {}", kMostCells),
             .help = "Cells of the grid: density (by a model of cost), 27n (27 a triangle), or a number (the "
                     "report's is 100000)"},
            into(o.accel_options.grid, parse_grid_cells));
}

std::optional<std::uint32_t> parse_spp(const std::string& text) {
  const auto spp = parse_number<std::uint32_t>(text);
  return spp && *spp >= 1 && *spp <= RenderSettings::kMostSamples ? spp : std::nullopt;
}

void add_stop_options(CLI::App& app, RenderOptions& o) {
  add_value(app,
            {.flag = "--spp",
             .type = "N",
             .fallback = fmt::format("{}", o.settings.spp),
             .expected = fmt::format("a whole number from 1 to {}", RenderSettings::kMostSamples),
             .help = "Samples a pixel; with --time or --target-error, at most"},
            into(o.spp, parse_spp));
  add_value(
      app,
      {.flag = "--time",
       .type = "S",
       .expected = "a number above 0",
       .help =
           "Stop after so many seconds of rendering, with the same samples in all pixels; the file tells how "
           "many, and --spp with that number makes it again"},
      into(o.seconds, parse_positive));
  add_value(
      app,
      {.flag = "--target-error",
       .type = "E",
       .expected = "a number above 0",
       .help = "Stop when the estimated relMSE, the mean of variance / (I^2 + 0.01), is E or less; looked at "
               "from 16 samples on. 0.01 is an error of about a tenth of the pixel's value"},
      into(o.target_relmse, parse_positive));
  add_file(
      app,
      {.flag = "--reference",
       .type = "FILE.exr",
       .expected = "an image file",
       .help = "Measure the error against this image at every doubling of the samples, for the summary and "
               "--stats"},
      [&o](const auto& path) { o.reference = path; });
}

void add_output_options(CLI::App& app, RenderOptions& o) {
  constexpr float any = -std::numeric_limits<float>::infinity();
  add_file(app,
           {.flag = "-o,--output",
            .type = "FILE",
            .expected = "an image file's name, with its ending",
            .help = "Image to write, may be given several times: .exr holds linear radiance and the options, "
                    ".png, .jpg, .tif ... a picture. Default: SCENE's name with .exr, in this folder",
            .repeats = true},
           [&o](const auto& path) { o.outputs.push_back(path); });
  add_choice(
      app, "--tonemap", tone_curves(), [&o](auto& entry) { o.tone_map.curve = entry.value; },
      "Curve of pictures");
  add_real(app, "--max-radiance", o.tone_map.max_radiance, 0, "Radiance that becomes white in pictures");
  add_real(app, "--gamma", o.tone_map.gamma, 0, "Exponent of --tonemap gamma");
  add_real(app, "--exposure", o.tone_map.exposure, any, "Stops that pictures are brightened by");
  add_file(app,
           {.flag = "--stats",
            .type = "FILE.json",
            .expected = "a file's name",
            .help = "Write the figures of the run as JSON"},
           [&o](const auto& path) { o.stats = path; });
  add_choice(
      app, "--progress", progress_styles(), [&o](auto& entry) { o.progress = entry.value; },
      "Progress on stderr");
  app.add_flag("-q,--quiet", o.quiet, "Print nothing but errors");
}

void add_pixel_options(CLI::App& app, RenderOptions& o) {
  add_value(app,
            {.flag = "--pixel",
             .type = "X,Y",
             .expected = "X,Y, e.g. 12,7; 0,0 is the upper left pixel",
             .help = "Render this pixel alone and print its radiance; no image is written"},
            [&o](const std::string& text) { return (o.pixel = parse_pixel(text)).has_value(); });
  app.add_flag("--explain", o.explain,
               "Tell what happens on each path of --pixel: vertices, densities of every sampling, weights, "
               "contributions, roulette");
  add_file(app,
           {.flag = "--explain-json",
            .type = "FILE.json",
            .expected = "a file's name",
            .help = "Write what --explain tells as JSON"},
           [&o](const auto& path) { o.explain_json = path; });
}

}  // namespace

CLI::App* add_render_command(CLI::App& app, RenderOptions& o) {
  CLI::App* render = app.add_subcommand("render", "Render a scene to image files");
  add_scene_options(*render, o.scene);
  add_output_options(*render, o);
  add_accelerator_options(*render, o);
  add_transport_options(*render, o);
  add_stop_options(*render, o);
  add_choice(
      *render, "--sampler", sequences(), [&o](auto& entry) { o.settings.sequence = entry.value; },
      "Random numbers");
  add_integer(
      *render, "--replicates", o.settings.replicates, 1, 64,
      "Independent scramblings of --sampler sobol that a pixel's samples take turns with. With 2 or more the "
      "layer \"variance\" has no bias, but the image more noise; with 1 it is made from the halves of one "
      "sequence and rather too large");
  add_integer(*render, "--seed", o.settings.seed, 0, std::numeric_limits<std::uint64_t>::max(),
              "Seed of the random numbers: the same seed, the same image");
  add_integer(*render, "--threads", o.threads, 0, 1024,
              "Threads; 0: all of the machine. The image does not depend on it");
  add_value(*render,
            {.flag = "--size",
             .type = "WxH",
             .expected = fmt::format("WIDTHxHEIGHT, each from 1 to {}, e.g. 1280x720", kLargestEdge),
             .help = "Image size in place of the scene's"},
            into(o.size, parse_size));
  add_pixel_options(*render, o);
  return render;
}

}  // namespace lemma
