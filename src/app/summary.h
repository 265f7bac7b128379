#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/app/options.h"
#include "src/measure/error_figures.h"
#include "src/measure/estimated_error.h"

namespace lemma {

/// The error against a reference at one moment of a rendering.
struct ErrorPoint {
  std::uint32_t spp = 0;
  double seconds = 0, cpu_seconds = 0;
  double mse = 0, relmse = 0;  // less the noise of the reference, if it tells its variance: can be below 0
};

/// The figures of one rendering.
struct RunFigures {
  std::string model;        // what the scene needs
  std::string accelerator;  // its own description
  std::size_t accelerator_bytes = 0;
  double accel_build_seconds = 0;
  int threads = 0;
  EstimatedError error;           // 0 if there is no estimate: with one sample a pixel
  std::vector<ErrorPoint> curve;  // with --reference
  std::optional<ReferenceNoise> reference_noise;
  std::optional<bool> target_reached;  // with --target-error
};

/// For people: a few lines.
[[nodiscard]] std::string summary_text(const RenderOptions& options, const RunFigures& figures,
                                       const RenderResult& result);

/// For programs: a JSON object.
[[nodiscard]] std::string summary_json(const RenderOptions& options, const RunFigures& figures,
                                       const RenderResult& result);

}  // namespace lemma
