#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "src/app/options.h"
#include "src/render/explain.h"

namespace lemma {

/// One sample of a pixel for people: a line for each event, indented by the surface it happens at.
[[nodiscard]] std::string path_text(const ExplainedSample& sample);

/// The same for programs.
[[nodiscard]] nlohmann::ordered_json path_json(const ExplainedSample& sample);

/// A JSON file of a pixel and its samples.
[[nodiscard]] std::string pixel_json(const RenderOptions& options, const ExplainedPixel& pixel,
                                     nlohmann::ordered_json samples);

}  // namespace lemma
