#include "src/app/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

std::string interval_text(const Interval& i) {
  return fmt::format("{:.4g} ({:.4g} to {:.4g})", i.value, i.low, i.high);
}

/// Whether the variance is estimated from halves of one scrambled sequence, see Film.
bool rather_too_large(const RenderOptions& options) {
  return options.settings.sequence == Sequence::sobol && options.settings.replicates == 1;
}

std::string error_text(const RenderOptions& options, const RunFigures& figures) {
  if (figures.error.rmse.value == 0) return {};
  return fmt::format("estimated error: RMSE {}, relMSE {}, 95 %{}\n", interval_text(figures.error.rmse),
                     interval_text(figures.error.relmse),
                     rather_too_large(options) ? "; rather too large, --replicates 2 has no bias" : "");
}

std::string target_text(const RenderOptions& options, const RunFigures& figures) {
  if (!figures.target_reached) return {};
  return fmt::format("target error: relMSE {} {}\n", *options.target_relmse,
                     *figures.target_reached ? "reached" : "not reached: more samples or time are needed");
}

/// A difference of squared errors of which more than this part is the reference's own tells nothing.
constexpr double kLeastErrorOfNoise = 0.5;

std::string curve_text(const RunFigures& figures) {
  if (figures.curve.empty()) return {};
  std::string text = "against the reference";
  const ReferenceNoise noise = figures.reference_noise.value_or(ReferenceNoise{});
  if (figures.reference_noise) {
    text += fmt::format(", whose own noise is subtracted (RMSE {:.3g}, relMSE {:.3g})", std::sqrt(noise.mse),
                        noise.relmse);
  }
  text += fmt::format(":\n{:>10}{:>12}{:>14}{:>14}\n", "spp", "seconds", "RMSE", "relMSE");
  const auto shown = [](double error, double of_reference, double value) {
    const bool measured = error >= kLeastErrorOfNoise * of_reference;
    return measured ? fmt::format("{:>14.6g}", value) : fmt::format("{:>14}", "below noise");
  };
  for (const ErrorPoint& p : figures.curve) {
    text += fmt::format("{:>10}{:>12.3f}{}{}\n", p.spp, p.seconds,
                        shown(p.mse, noise.mse, std::sqrt(std::max(p.mse, 0.0))),
                        shown(p.relmse, noise.relmse, p.relmse));
  }
  return text;
}

nlohmann::ordered_json to_json(const Interval& i) {
  return {{"value", i.value}, {"low", i.low}, {"high", i.high}};
}

nlohmann::ordered_json curve_json(const std::vector<ErrorPoint>& curve) {
  auto points = nlohmann::ordered_json::array();
  for (const ErrorPoint& p : curve) {
    points.push_back({{"spp", p.spp},
                      {"seconds", p.seconds},
                      {"cpu_seconds", p.cpu_seconds},
                      {"mse", p.mse},
                      {"rmse", p.mse >= 0 ? nlohmann::ordered_json(std::sqrt(p.mse)) : nullptr},
                      {"relmse", p.relmse}});
  }
  return points;
}

}  // namespace

std::string summary_text(const RenderOptions& options, const RunFigures& figures,
                         const RenderResult& result) {
  std::string text = fmt::format("model: {}\n", figures.model);
  text += fmt::format("accelerator: {}, built in {:.3f} s, {:.1f} MB\n", figures.accelerator,
                      figures.accel_build_seconds, static_cast<double>(figures.accelerator_bytes) / 1e6);
  text += fmt::format("samples: {} spp, {} camera samples, {:.3g} million/s\n", result.spp,
                      result.camera_samples, rate(result.camera_samples, result.seconds) / 1e6);
  text +=
      fmt::format("rays: {}, {:.3g} million/s, {:.0f} % of the time in the accelerator\n", result.counts.rays,
                  rate(result.counts.rays, result.seconds) / 1e6, 100 * traversal_share(result.counts));
  text += fmt::format("time: {:.3f} s on {} threads\n", result.seconds, figures.threads);
  text += error_text(options, figures) + target_text(options, figures) + curve_text(figures);
  if (result.counts.paths_cut > 0) {
    text += fmt::format("paths cut at depth {}: {} (the image lacks their light)\n",
                        options.integrator_options.max_depth, result.counts.paths_cut);
  }
  return text + invalid_text(result) + "\n";
}

std::string summary_json(const RenderOptions& options, const RunFigures& figures,
                         const RenderResult& result) {
  nlohmann::ordered_json json = {
      {"version", LEMMA_VERSION},
      {"scene", options.scene.scene.string()},
      {"model", figures.model},
      {"accel", options.accel.name},
      {"accel_description", figures.accelerator},
      {"accel_build_seconds", figures.accel_build_seconds},
      {"accel_bytes", figures.accelerator_bytes},
      {"integrator", options.integrator.name},
      {"lights", options.lights.name},
      {"mis", name_of(heuristics(), options.integrator_options.heuristic)},
      {"sampler", name_of(sequences(), options.settings.sequence)},
      {"replicates", options.settings.replicates},
      {"seed", options.settings.seed},
      {"threads", figures.threads},
      {"width", result.image.width},
      {"height", result.image.height},
      {"spp", result.spp},
      {"camera_samples", result.camera_samples},
      {"rays", result.counts.rays},
      {"render_seconds", result.seconds},
      {"render_cpu_seconds", result.cpu_seconds},
      {"camera_samples_per_second", rate(result.camera_samples, result.seconds)},
      {"rays_per_second", rate(result.counts.rays, result.seconds)},
      {"traversal_share", traversal_share(result.counts)},
      {"paths_cut", result.counts.paths_cut},
      {"invalid_samples", result.invalid_samples},
  };
  if (figures.error.rmse.value > 0) {
    json["estimated_error"] = {{"rmse", to_json(figures.error.rmse)},
                               {"relmse", to_json(figures.error.relmse)},
                               {"rather_too_large", rather_too_large(options)}};
  }
  if (figures.target_reached) json["target_reached"] = *figures.target_reached;
  if (!figures.curve.empty()) {
    json["reference"] = options.reference.string();
    if (figures.reference_noise) {
      json["reference_noise"] = {{"mse", figures.reference_noise->mse},
                                 {"relmse", figures.reference_noise->relmse}};
    }
    json["error_curve"] = curve_json(figures.curve);
  }
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // names of files may be no UTF-8
  return json.dump(2, ' ', false, replace) + "\n";
}

}  // namespace lemma
