#include "src/app/trace_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "src/app/ray_file.h"
#include "src/app/value_option.h"
#include "src/core/parallel.h"
#include "src/render/whole_file.h"
#include "src/scene/load_geometry.h"

namespace lemma {
namespace {

constexpr std::size_t kRaysATask = 4096;

/// One answer a ray. For --any the triangle is 0 where anything is hit.
std::vector<std::optional<Hit>> trace(const Accelerator& accel, const std::vector<Ray>& rays, bool any) {
  std::vector<std::optional<Hit>> hits(rays.size());
  parallel_for((rays.size() + kRaysATask - 1) / kRaysATask, [&](std::size_t task) {
    const std::size_t end = std::min(rays.size(), (task + 1) * kRaysATask);
    for (std::size_t i = task * kRaysATask; i < end; ++i) {
      if (!any) hits[i] = accel.closest_hit(rays[i]);
      if (any && accel.occluded(rays[i])) hits[i] = Hit{};
    }
  });
  return hits;
}

}  // namespace

CLI::App* add_trace_command(CLI::App& app, TraceOptions& o) {
  CLI::App* trace = app.add_subcommand("trace", "Read rays from a file, write what they hit");
  add_file(*trace,
           {.flag = "SCENE",
            .type = "PATH",
            .expected = "an OBJ file, or an XML file or a folder that leads to one",
            .help = "The OBJ file, or the XML file or the folder beside it; camera, lights and materials are "
                    "not needed"},
           [&o](const auto& path) { o.scene = path; })
      ->required();
  add_file(*trace,
           {.flag = "--rays",
            .type = "FILE",
            .expected = "a file of rays",
            .help = "Rays, 8 float32 each: ox oy oz tmin dx dy dz tmax"},
           [&o](const auto& path) { o.rays = path; })
      ->required();
  add_file(*trace,
           {.flag = "-o,--output",
            .type = "FILE",
            .expected = "a file's name",
            .help = "Hits, 16 bytes each: int32 triangle, counted in the order of the OBJ, polygons as fans, "
                    "or -1 for none; float32 t, b1, b2"},
           [&o](const auto& path) { o.output = path; })
      ->required();
  add_choice(
      *trace, "--accel", accelerators(), [&o](auto& entry) { o.accel = entry; },
      "What finds the triangle a ray hits");
  trace->add_flag("--any", o.any, "Tell only whether there is a hit: triangle 0, else -1");
  trace->add_flag("-q,--quiet", o.quiet, "Print nothing but errors");
  return trace;
}

ExitCode run_trace(const TraceOptions& options) {
  check_whole_file(options.output);
  const std::vector<Ray> rays = read_rays(options.rays);
  const Geometry geometry = load_geometry(options.scene);
  const auto accel = options.accel.value(geometry.triangles, {});
  std::vector<std::optional<Hit>> hits = trace(*accel, rays, options.any);
  std::size_t count = 0;
  for (std::optional<Hit>& hit : hits) {
    if (!hit) continue;
    ++count;
    if (!options.any) hit->triangle = geometry.file_index[hit->triangle];
  }
  write_whole_file(options.output, hit_bytes(hits));
  if (options.quiet) return kDone;
  for (const std::string& warning : geometry.warnings) fmt::print(stderr, "{}\n", warning);
  fmt::print("{}\n{} rays, {} of them hit\n", accel->description(), rays.size(), count);
  return kDone;
}

}  // namespace lemma
