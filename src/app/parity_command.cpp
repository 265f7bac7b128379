#include "src/app/parity_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "src/app/number_option.h"
#include "src/app/parity_report.h"
#include "src/app/progress.h"
#include "src/core/parallel.h"
#include "src/render/whole_file.h"
#include "src/scene/load_geometry.h"
#include "src/scene/load_scene.h"

namespace lemma {
namespace {

/// Tests of a ray against a triangle that brute force is given, a minute's work or less.
constexpr double kMostBruteTests = 2e9;

/// Triangles, and camera and lights if the scene has them: a bare OBJ has not.
struct ParityInput {
  Geometry geometry;
  std::optional<LoadedScene> scene{};
  std::optional<Camera> camera{};
  std::unique_ptr<const LightSampler> lights{};
};

ParityInput load(const ParityOptions& options) {
  ParityInput input{.geometry = load_geometry(options.scene)};
  if (options.scene.extension() == ".obj") return input;
  input.scene = load_scene(options.scene);
  input.camera.emplace(input.scene->scene.view);
  // One that draws points, which shadow rays end at.
  const auto by_points = find_named(light_samplers(), std::string_view("solid-angle")).value();
  input.lights = by_points(input.scene->scene.emitters, input.scene->scene.triangles);
  return input;
}

struct Backends {
  std::vector<std::unique_ptr<const Accelerator>> owned;
  std::vector<Contestant> contestants;
};

Backends build_all(std::span<const Triangle> triangles, std::uint32_t rays) {
  Backends backends;
  for (const Named<AcceleratorFactory>& entry : accelerators()) {
    backends.owned.push_back(entry.value(triangles, {}));
    Contestant contestant{entry.name, backends.owned.back().get()};
    if (entry.name == "brute") {
      const double tests = static_cast<double>(rays) * static_cast<double>(triangles.size());
      contestant.stride = static_cast<std::uint32_t>(std::ceil(std::max(1.0, tests / kMostBruteTests)));
    }
    backends.contestants.push_back(contestant);
  }
  return backends;
}

bool ours_are_right(std::span<const Record> records) {
  return std::ranges::all_of(records,
                             [](const Record& r) { return is_foreign(r.name) || r.total().faults() == 0; });
}

}  // namespace

CLI::App* add_parity_command(CLI::App& app, ParityOptions& o) {
  CLI::App* parity = app.add_subcommand("parity", "Check every accelerator against an exact oracle");
  add_file(*parity,
           {.flag = "SCENE",
            .type = "PATH",
            .expected = "an XML file, an OBJ file, or the folder that holds both",
            .help = "An XML file or a folder: with its camera and lights; an OBJ file: geometry alone"},
           [&o](const auto& path) { o.scene = path; })
      ->required();
  add_integer(
      *parity, "--rays", o.rays, 20, 4000000000u,
      "Rays: a fifth each from the camera, bounces and shadows, the rest made to be hard. Brute force "
      "is asked fewer where there are many triangles");
  add_integer(*parity, "--seed", o.seed, 0, std::numeric_limits<std::uint64_t>::max(),
              "Seed of the random numbers: the same seed, the same rays");
  add_integer(*parity, "--threads", o.threads, 0, 1024, "Threads; 0: all of the machine");
  add_file(
      *parity,
      {.flag = "--json", .type = "FILE.json", .expected = "a file's name", .help = "Write the table as JSON"},
      [&o](const auto& path) { o.json = path; });
  add_choice(
      *parity, "--progress", progress_styles(), [&o](auto& entry) { o.progress = entry.value; },
      "Progress on stderr");
  parity->add_flag("-q,--quiet", o.quiet, "Print nothing but errors");
  parity->footer(
      "Columns: decided: every sound float32 answer is the same; vertex ... tie: why it is not; wrong: a "
      "triangle that\ncannot be the nearest, or t beyond its bound; missed: no hit where there must be one, "
      "also between the triangles\nof an edge or vertex; occlusion: wrong answers to whether anything is "
      "hit; "
      "t error: the largest, in units of its\nbound. Exit code 3: an accelerator of Lemma's own gave such an "
      "answer. Embree's are shown only.");
  return parity;
}

ExitCode run_parity(const ParityOptions& options) {
  if (!options.json.empty()) check_whole_file(options.json);
  const ThreadLimit limit(options.threads);
  const ParityInput input = load(options);
  const std::span<const Triangle> triangles = input.geometry.triangles;
  const Backends backends = build_all(triangles, options.rays);
  const Oracle oracle(triangles);
  const RaySource source({.triangles = triangles,
                          .walker = backends.owned.front().get(),
                          .camera = input.camera ? &*input.camera : nullptr,
                          .lights = input.lights.get()},
                         options.seed);
  Progress progress(options.quiet ? ProgressStyle::off : options.progress);
  const std::vector<Record> records = check_parity(oracle, source, backends.contestants, options.rays,
                                                   [&](double done) { progress.update(done); });
  if (!options.json.empty()) write_whole_file(options.json, parity_json(options, records));
  if (!options.quiet) fmt::print("{}", parity_text(options, records));
  return ours_are_right(records) ? kDone : kComparisonFailed;
}

}  // namespace lemma
