#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/app/exit_code.h"
#include "src/measure/statistical_test.h"

namespace CLI {
class App;
}

namespace lemma {

/// A figure that must not be above a limit.
struct FigureLimit {
  std::string figure;  // as compare_figures() names it
  double most = 0;
};

/// Everything `lemma compare` can be told.
struct CompareOptions {
  std::filesystem::path image, reference;
  std::filesystem::path output;  // difference image; empty: none
  std::optional<double> scale;   // difference of luminance at which its colours are full; none: by the image
  std::filesystem::path json;    // empty: none
  std::vector<FigureLimit> limits;
  bool statistical = false;
  TestSettings test;
  std::uint32_t largest = 5;  // pixels shown
  bool quiet = false;         // nothing is printed but errors
};

/// Adds the command and binds its options to `options`.
CLI::App* add_compare_command(CLI::App& app, CompareOptions& options);

/// `lemma compare`: error figures of an image against a reference, and whether they could have the same mean.
/// @return kComparisonFailed if a figure is above its limit or the statistical test tells the images apart
/// @throw std::runtime_error whose what() is the message for the user
[[nodiscard]] ExitCode run_compare(const CompareOptions& options);

}  // namespace lemma
