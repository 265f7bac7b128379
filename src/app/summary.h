#pragma once

#include <string>

#include "src/app/options.h"

namespace lemma {

/// The figures of one rendering.
struct RunFigures {
  std::string model;        // what the scene needs
  std::string accelerator;  // its own description
  std::size_t accelerator_bytes = 0;
  double accel_build_seconds = 0;
  int threads = 0;
};

/// For people: a few lines.
[[nodiscard]] std::string summary_text(const RenderOptions& options, const RunFigures& figures,
                                       const RenderResult& result);

/// For programs: a JSON object.
[[nodiscard]] std::string summary_json(const RenderOptions& options, const RunFigures& figures,
                                       const RenderResult& result);

}  // namespace lemma
