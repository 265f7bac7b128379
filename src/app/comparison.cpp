#include "src/app/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/measure/difference_image.h"
#include "src/measure/flip.h"

namespace lemma {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kChannelNames = {"R", "G", "B"};

/// Whether both were rendered with the same random numbers.
bool have_same_seed(const ReadImage& image, const ReadImage& reference) {
  return !image.seed.empty() && image.seed == reference.seed;
}

std::string seed_line(const ReadImage& image, const ReadImage& reference) {
  if (!have_same_seed(image, reference)) return {};
  return fmt::format("both were rendered with --seed {}: what they err alike shows in no figure or test\n",
                     image.seed);
}

std::string figure_lines(const Comparison& comparison) {
  std::string text;
  for (const auto& [name, value] : compare_figures(comparison)) {
    text += fmt::format("{:<16} {:.6g}\n", name, value);
  }
  return text;
}

/// What is left of the squared errors without the noise of the reference.
std::string corrected_lines(const Comparison& c) {
  if (!c.noise) return {};
  const double mse = c.errors.mse - c.noise->mse, relmse = c.errors.relmse - c.noise->relmse;
  return fmt::format(
      "without the reference's own noise (its RMSE {:.3g}, relMSE {:.3g}): RMSE {:.6g}, relMSE {:.6g}\n",
      std::sqrt(c.noise->mse), c.noise->relmse, std::sqrt(std::max(0.0, mse)), std::max(0.0, relmse));
}

std::string mean_difference_line(const Comparison& c) {
  std::string text = "mean difference ";
  for (std::size_t i = 0; i < 3; ++i) {
    text += fmt::format(" {} {:+.4g}", kChannelNames[i], c.errors.mean_difference[i]);
    if (c.standard_error) text += fmt::format(" +- {:.2g}", (*c.standard_error)[i]);
  }
  return text + (c.standard_error ? " (standard error)\n" : "\n");
}

std::string color_text(const Rgb& c) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", c.r, c.g, c.b);
}

std::string largest_lines(const ReadImage& image, const ReadImage& reference, const Comparison& c) {
  std::string text;
  for (const PixelDifference& p : c.largest) {
    text += fmt::format("  pixel {},{}: {} in place of {}\n", p.x, p.y, color_text(image.image.at(p.x, p.y)),
                        color_text(reference.image.at(p.x, p.y)));
  }
  return text.empty() ? text : "largest differences\n" + text;
}

/// The bias of everything that the global test sees in half of all cases, as a part of the channel's mean.
double visible_bias(const StatisticalResult& t, const Image& reference, std::size_t channel) {
  double sum = 0;
  for (const Rgb& c : reference.pixels) sum += std::array<double, 3>{c.r, c.g, c.b}[channel];
  const double mean = sum / static_cast<double>(reference.pixels.size());
  return mean != 0 ? t.global_limit * t.standard_error[channel] / std::abs(mean) : 0;
}

std::string test_lines(const CompareOptions& options, const ReadImage& reference,
                       const StatisticalResult& t) {
  std::string text =
      fmt::format("statistical test, false alarms in {:g} of comparisons of equal means at most\n",
                  options.test.false_alarm);
  text += fmt::format(
      "  blocks of {0} x {0}: {1} of {2} tests beyond |z| = {3:.2f}; the largest is {4:+.2f}, channel {5} at "
      "{6},{7}\n",
      options.test.block, t.block_alarms, t.block_tests, t.block_limit, t.worst.z,
      kChannelNames[static_cast<std::size_t>(t.worst.channel)], t.worst.x, t.worst.y);
  text += "  whole image:";
  for (std::size_t i = 0; i < 3; ++i) text += fmt::format(" {} z {:+.2f}", kChannelNames[i], t.global_z[i]);
  text += fmt::format("; limit {:.2f}, reached by a bias of {:.2g} %\n", t.global_limit,
                      100 * visible_bias(t, reference.image, 1));
  return text + (t.different() ? "  verdict: different\n" : "  verdict: no difference found\n");
}

Json test_json(const CompareOptions& options, const StatisticalResult& t) {
  return {
      {"different", t.different()},
      {"false_alarm", options.test.false_alarm},
      {"block", options.test.block},
      {"block_tests", t.block_tests},
      {"block_alarms", t.block_alarms},
      {"block_limit", t.block_limit},
      {"worst_block", {{"x", t.worst.x}, {"y", t.worst.y}, {"channel", t.worst.channel}, {"z", t.worst.z}}},
      {"global_z", t.global_z},
      {"global_limit", t.global_limit},
      {"mean_difference", t.difference},
      {"standard_error", t.standard_error}};
}

Json largest_json(const ReadImage& image, const ReadImage& reference, const Comparison& c) {
  Json pixels = Json::array();
  const auto values = [](const Rgb& p) { return Json::array({p.r, p.g, p.b}); };
  for (const PixelDifference& p : c.largest) {
    pixels.push_back({{"x", p.x},
                      {"y", p.y},
                      {"image", values(image.image.at(p.x, p.y))},
                      {"reference", values(reference.image.at(p.x, p.y))}});
  }
  return pixels;
}

/// What the figures depend on beside the images.
Json settings_json(const ReadImage& reference) {
  Json flip = {{"pixels_per_degree", kFlipPixelsPerDegree}};
  if (reference.linear) {
    const FlipExposures exposures = flip_exposures(reference.image);
    flip.update({{"first_exposure", exposures.first},
                 {"last_exposure", exposures.exposure(exposures.count - 1)},
                 {"exposures", exposures.count},
                 {"tone_map", "aces"}});
  }
  return {{"relmse", {{"epsilon", kRelativeFloor}}},
          {"trimmed-relmse", {{"epsilon", kRelativeFloor}, {"left_out", kTrimmedPart}}},
          {"flip", flip}};
}

Json limits_json(const CompareOptions& options, const Comparison& c) {
  Json limits = Json::array();
  for (const FigureLimit& limit : options.limits) {
    const double value = figure_of(c, limit.figure);
    limits.push_back(
        {{"figure", limit.figure}, {"most", limit.most}, {"value", value}, {"exceeded", value > limit.most}});
  }
  return limits;
}

/// What the pixels of the difference image mean.
Json difference_json(const CompareOptions& options, const Comparison& c) {
  Json difference = {{"file", options.output.string()}};
  if (!c.color_scale) {
    difference["of"] = "channels";
    return difference;
  }
  difference["of"] = "luminance";
  difference["scale"] = *c.color_scale;
  Json colors = Json::array();
  for (std::size_t i = 0; i < kDifferenceColors.size(); ++i) {
    const double place = 2 * static_cast<double>(i) / (kDifferenceColors.size() - 1) - 1;
    const Rgb& color = kDifferenceColors[i];
    colors.push_back({{"difference", place * *c.color_scale}, {"color", {color.r, color.g, color.b}}});
  }
  difference["colors"] = colors;
  return difference;
}

}  // namespace

NamedFigures compare_figures(const Comparison& c) {
  return {{"rmse", std::sqrt(c.errors.mse)},
          {"relmse", c.errors.relmse},
          {"trimmed-relmse", c.errors.trimmed_relmse},
          {"smape", c.errors.smape},
          {"flip", c.flip}};
}

double figure_of(const Comparison& c, const std::string& name) {
  const NamedFigures figures = compare_figures(c);
  return std::ranges::find(figures, name, &NamedFigures::value_type::first)->second;
}

std::string comparison_text(const CompareOptions& options, const ReadImage& image, const ReadImage& reference,
                            const Comparison& c) {
  std::string text =
      seed_line(image, reference) + figure_lines(c) + corrected_lines(c) + mean_difference_line(c);
  text += largest_lines(image, reference, c);
  if (c.color_scale) {
    text += fmt::format(
        "difference image: {}, luminance from {:.3g} too dark (blue) to {:.3g} too bright (red)\n",
        options.output.string(), *c.color_scale, *c.color_scale);
  }
  if (c.test) text += test_lines(options, reference, *c.test);
  for (const FigureLimit& limit : c.exceeded)
    text += fmt::format("{} is above {:g}\n", limit.figure, limit.most);
  return text;
}

std::string comparison_json(const CompareOptions& options, const ReadImage& image, const ReadImage& reference,
                            const Comparison& c) {
  Json json = {{"version", LEMMA_VERSION},
               {"image", options.image.string()},
               {"reference", options.reference.string()},
               {"width", image.image.width},
               {"height", image.image.height},
               {"same_seed", have_same_seed(image, reference)}};
  for (const auto& [name, value] : compare_figures(c)) json[name] = value;
  if (c.noise) {
    json["reference_noise"] = {{"mse", c.noise->mse}, {"relmse", c.noise->relmse}};
    json["mse_without_noise"] = c.errors.mse - c.noise->mse;
    json["relmse_without_noise"] = c.errors.relmse - c.noise->relmse;
  }
  json["mean_difference"] = c.errors.mean_difference;
  if (c.standard_error) json["mean_difference_standard_error"] = *c.standard_error;
  json["largest_differences"] = largest_json(image, reference, c);
  if (c.test) json["statistical"] = test_json(options, *c.test);
  json["settings"] = settings_json(reference);
  json["limits"] = limits_json(options, c);
  if (!options.output.empty()) json["difference_image"] = difference_json(options, c);
  json["exceeded"] = Json::array();
  for (const FigureLimit& limit : c.exceeded) json["exceeded"].push_back(limit.figure);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // file names may be no UTF-8
}

}  // namespace lemma
