#include "src/app/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>

#include "src/app/choice_option.h"

namespace lemma {
namespace {

constexpr int kLargestSize = 65536;  // pixels an edge

/// The whole text as a number; nothing if it is none.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

[[noreturn]] void reject(const std::string& flag, const std::string& value, const std::string& expected) {
  throw CLI::ValidationError(flag, fmt::format("unknown value \"{}\"\n  hint: expected {}", value, expected));
}

/// Adds an option that takes a whole number in [lowest, highest].
template <class T>
void add_integer(CLI::App& app, const std::string& flag, T& value, std::type_identity_t<T> lowest,
                 std::type_identity_t<T> highest, const std::string& help) {
  const auto read = [=, &value](const std::string& text) {
    const std::optional<T> number = parse_number<T>(text);
    if (!number || *number < lowest || *number > highest) {
      reject(flag, text, fmt::format("a whole number from {} to {}", lowest, highest));
    }
    value = *number;
  };
  app.add_option_function<std::string>(flag, read, help)
      ->type_name("N")
      ->default_str(fmt::format("{}", value));
}

/// Adds an option that takes a finite number above `above`.
void add_real(CLI::App& app, const std::string& flag, float& value, float above, const std::string& help) {
  const auto read = [=, &value](const std::string& text) {
    const std::optional<float> number = parse_number<float>(text);
    if (!number || !std::isfinite(*number) || !(*number > above)) {
      reject(flag, text,
             above > std::numeric_limits<float>::lowest() ? fmt::format("a number above {}", above)
                                                          : std::string("a number"));
    }
    value = *number;
  };
  app.add_option_function<std::string>(flag, read, help)
      ->type_name("X")
      ->default_str(fmt::format("{}", value));
}

void read_size(const std::string& text, std::optional<std::pair<int, int>>& size) {
  const auto x = text.find('x');
  std::optional<int> width, height;
  if (x != std::string::npos) {
    width = parse_number<int>(text.substr(0, x));
    height = parse_number<int>(text.substr(x + 1));
  }
  if (!width || !height || *width < 1 || *height < 1 || *width > kLargestSize || *height > kLargestSize) {
    reject("--size", text, fmt::format("WIDTHxHEIGHT, each from 1 to {}, e.g. 1280x720", kLargestSize));
  }
  size.emplace(*width, *height);
}

void read_grid_cells(const std::string& text, GridResolution& resolution) {
  constexpr std::size_t most = std::size_t{1} << 28;
  resolution = {};
  if (text == "density") return;
  if (text == "27n") {
    resolution.rule = GridResolution::Rule::twenty_seven;
    return;
  }
  const auto cells = parse_number<std::size_t>(text);
  if (!cells || *cells < 1 || *cells > most) {
    reject("--grid-cells", text, fmt::format("one of: density, 27n, or a whole number from 1 to {}", most));
  }
  resolution.cells = *cells;
}

void add_transport_options(CLI::App& app, RenderOptions& o) {
  static constexpr Named<PhongNorm> norms[] = {
      {"n+1", PhongNorm::n_plus_1, "(n + 1) / (2 pi), the report's eq. (3)"},
      {"n+2", PhongNorm::n_plus_2, "(n + 2) / (2 pi), albedo 1 at normal incidence for ks 1"}};
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
      app, "--rr", roulettes(), [&o](auto& entry) { o.integrator_options.roulette = entry.value; },
      "Russian roulette");
  add_integer(
      app, "--max-depth", o.integrator_options.max_depth, 0, IntegratorOptions::kLastResortDepth,
      "Scattering events on a path at most; 1 is direct light. Paths cut are counted: they make a bias");
  add_choice(
      app, "--phong-norm", std::span<const Named<PhongNorm>>(norms),
      [&o](auto& entry) { o.load.phong_norm = entry.value; }, "Factor of the Phong lobe");
  add_choice(
      app, "--emitters", std::span<const Named<bool>>(emitters),
      [&o](auto& entry) { o.integrator_options.emitters_reflect = entry.value; },
      "What emitters do besides emitting");
}

void add_accelerator_options(CLI::App& app, RenderOptions& o) {
  add_choice(
      app, "--accel", accelerators(), [&o](auto& entry) { o.accel = entry; },
      "What finds the triangle a ray hits");
  app.add_option_function<std::string>(
         "--grid-cells", [&o](const std::string& text) { read_grid_cells(text, o.accel_options.grid); },
         "Cells of the grid: density (about 4 a triangle), 27n (27 a triangle), or a number (the report's is "
         "100000)")
      ->type_name("density|27n|N")
      ->default_str("density");
}

void add_output_options(CLI::App& app, RenderOptions& o) {
  static constexpr Named<ProgressStyle> styles[] = {
      {"auto", ProgressStyle::automatic, "a bar on a terminal, lines elsewhere"},
      {"bar", ProgressStyle::bar, "a bar that is drawn over and over"},
      {"plain", ProgressStyle::plain, "a line for every tenth"},
      {"off", ProgressStyle::off, "nothing"}};
  constexpr float any = std::numeric_limits<float>::lowest();
  app.add_option("-o,--output", o.outputs,
                 "Image to write, may be given several times: .exr holds linear radiance and the options, "
                 ".png, .jpg, .tif "
                 "... a picture. Default: SCENE's name with .exr, in this folder")
      ->type_name("FILE");
  add_choice(
      app, "--tonemap", tone_curves(), [&o](auto& entry) { o.tone_map.curve = entry.value; },
      "Curve of pictures");
  add_real(app, "--max-radiance", o.tone_map.max_radiance, 0, "Radiance that becomes white in pictures");
  add_real(app, "--gamma", o.tone_map.gamma, 0, "Exponent of --tonemap gamma");
  add_real(app, "--exposure", o.tone_map.exposure, any, "Stops that pictures are brightened by");
  app.add_option("--stats", o.stats, "Write the figures of the run as JSON")->type_name("FILE.json");
  add_choice(
      app, "--progress", std::span<const Named<ProgressStyle>>(styles),
      [&o](auto& entry) { o.progress = entry.value; }, "Progress on stderr");
  app.add_flag_callback(
      "-q,--quiet", [&o] { o.progress = ProgressStyle::off; }, "No progress, no summary");
}

}  // namespace

CLI::App* add_render_command(CLI::App& app, RenderOptions& o) {
  CLI::App* render = app.add_subcommand("render", "Render a scene to image files");
  render->add_option("SCENE", o.scene, "The XML file, the OBJ file, or the folder that holds both")
      ->required();
  add_output_options(*render, o);
  add_accelerator_options(*render, o);
  add_transport_options(*render, o);
  add_integer(*render, "--spp", o.settings.spp, 1, 1u << 30, "Samples a pixel");
  add_integer(*render, "--seed", o.settings.seed, 0, std::numeric_limits<std::uint64_t>::max(),
              "Seed of the random numbers: the same seed, the same image");
  add_integer(*render, "--threads", o.threads, 0, 1024,
              "Threads; 0: all of the machine. The image does not depend on it");
  render
      ->add_option_function<std::string>(
          "--size", [&o](const std::string& text) { read_size(text, o.size); },
          "Image size in place of the scene's")
      ->type_name("WxH");
  return render;
}

}  // namespace lemma
