#include "src/app/summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace lemma {
namespace {

double rate(std::uint64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds : 0.0;
}

/// Part of the time spent in the accelerator, from the samples that were timed; 0 if none was.
double traversal_share(const TraceCounts& counts) {
  if (counts.timed_ticks == 0) return 0;
  return static_cast<double>(counts.traversal_ticks) / static_cast<double>(counts.timed_ticks);
}

std::string invalid_text(const RenderResult& result) {
  std::string text = fmt::format("invalid samples: {}", result.invalid_samples);
  for (const InvalidSample& i : result.first_invalid) {
    text += fmt::format("\n  pixel {},{} sample {}: ({}, {}, {})", i.x, i.y, i.sample, i.value.r, i.value.g,
                        i.value.b);
  }
  return text;
}

}  // namespace

std::string summary_text(const RenderOptions& options, const RunFigures& figures,
                         const RenderResult& result) {
  std::string text = fmt::format("model: {}\n", figures.model);
  text += fmt::format("accelerator: {}, built in {:.3f} s, {:.1f} MB\n", figures.accelerator,
                      figures.accel_build_seconds, static_cast<double>(figures.accelerator_bytes) / 1e6);
  text += fmt::format("samples: {} spp, {} camera samples, {:.3g} million/s\n", options.settings.spp,
                      result.camera_samples, rate(result.camera_samples, result.seconds) / 1e6);
  text +=
      fmt::format("rays: {}, {:.3g} million/s, {:.0f} % of the time in the accelerator\n", result.counts.rays,
                  rate(result.counts.rays, result.seconds) / 1e6, 100 * traversal_share(result.counts));
  text += fmt::format("time: {:.3f} s on {} threads\n", result.seconds, figures.threads);
  if (result.counts.paths_cut > 0) {
    text += fmt::format("paths cut at depth {}: {} (the image lacks their light)\n",
                        options.integrator_options.max_depth, result.counts.paths_cut);
  }
  return text + invalid_text(result) + "\n";
}

std::string summary_json(const RenderOptions& options, const RunFigures& figures,
                         const RenderResult& result) {
  const nlohmann::ordered_json json = {
      {"version", LEMMA_VERSION},
      {"scene", options.scene.scene.string()},
      {"model", figures.model},
      {"accel", options.accel.name},
      {"accel_description", figures.accelerator},
      {"accel_build_seconds", figures.accel_build_seconds},
      {"accel_bytes", figures.accelerator_bytes},
      {"integrator", options.integrator.name},
      {"lights", options.lights.name},
      {"seed", options.settings.seed},
      {"threads", figures.threads},
      {"width", result.image.width},
      {"height", result.image.height},
      {"spp", options.settings.spp},
      {"camera_samples", result.camera_samples},
      {"rays", result.counts.rays},
      {"render_seconds", result.seconds},
      {"camera_samples_per_second", rate(result.camera_samples, result.seconds)},
      {"rays_per_second", rate(result.counts.rays, result.seconds)},
      {"traversal_share", traversal_share(result.counts)},
      {"paths_cut", result.counts.paths_cut},
      {"invalid_samples", result.invalid_samples},
  };
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // names of files may be no UTF-8
  return json.dump(2, ' ', false, replace) + "\n";
}

}  // namespace lemma
