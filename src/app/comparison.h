#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/app/compare_command.h"
#include "src/measure/error_figures.h"
#include "src/measure/statistical_test.h"
#include "src/render/read_image.h"

namespace lemma {

/// All that is found out about two images.
struct Comparison {
  ErrorFigures errors;
  double flip = 0;                      // mean over the pixels
  std::optional<ReferenceNoise> noise;  // of the reference, if it tells its variance
  /// Standard errors of the mean difference, a channel, if both images tell their variance.
  std::optional<std::array<double, 3>> standard_error;
  std::vector<PixelDifference> largest;
  std::optional<StatisticalResult> test;
  std::optional<double> color_scale;  // of the difference image, if it is a picture
  std::vector<FigureLimit> exceeded;
};

/// The figures that can be limited, by name.
using NamedFigures = std::vector<std::pair<std::string, double>>;
[[nodiscard]] NamedFigures compare_figures(const Comparison& comparison);

/// @param name  one of theirs
[[nodiscard]] double figure_of(const Comparison& comparison, const std::string& name);

/// For people: a few lines.
[[nodiscard]] std::string comparison_text(const CompareOptions& options, const ReadImage& image,
                                          const ReadImage& reference, const Comparison& comparison);

/// For programs: a JSON object.
[[nodiscard]] std::string comparison_json(const CompareOptions& options, const ReadImage& image,
                                          const ReadImage& reference, const Comparison& comparison);

}  // namespace lemma
