#include "src/app/compare_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/app/comparison.h"
#include "src/app/number_option.h"
#include "src/measure/difference_image.h"
#include "src/measure/flip.h"
#include "src/render/image_file.h"
#include "src/render/whole_file.h"

namespace lemma {
namespace {

std::string list_figures() {
  std::string names;
  for (const auto& [name, value] : compare_figures({})) names.append(names.empty() ? "" : ", ").append(name);
  return names;
}

/// "relmse=0.01" -> name and number.
std::optional<FigureLimit> parse_limit(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) return std::nullopt;
  const std::string name = text.substr(0, equals);
  const NamedFigures figures = compare_figures({});
  const bool known = std::ranges::any_of(figures, [&](const auto& figure) { return figure.first == name; });
  const auto most = parse_number<double>(std::string_view(text).substr(equals + 1));
  if (!known || !most || !(*most >= 0)) return std::nullopt;
  return FigureLimit{name, *most};
}

std::optional<double> parse_chance(const std::string& text) {
  const auto chance = parse_number<double>(text);
  return chance && *chance > 0 && *chance < 1 ? chance : std::nullopt;
}

void add_test_options(CLI::App& app, CompareOptions& o) {
  app.add_flag(
      "--statistical", o.statistical,
      "Test whether both could have the same mean, block by block and as a whole; both files must hold "
      "variances, as EXR files of lemma render do. Exit code 3 if they could not");
  add_value(app,
            {.flag = "--false-alarm",
             .type = "P",
             .fallback = fmt::format("{}", o.test.false_alarm),
             .expected = "a probability between 0 and 1",
             .help = "Chance that --statistical calls images of the same mean different"},
            into(o.test.false_alarm, parse_chance));
  add_integer(app, "--block", o.test.block, 4, 4096, "Edge of the blocks of --statistical [pixels]");
}

void require_comparable(const CompareOptions& options, const ReadImage& image, const ReadImage& reference) {
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    return std::runtime_error(fmt::format("{}: error: {} {}\n  hint: {}", options.image.string(), what,
                                          options.reference.string(), hint));
  };
  const Image &a = image.image, &r = reference.image;
  if (a.width != r.width || a.height != r.height) {
    throw refuse(fmt::format("{}x{} pixels cannot be compared with the {}x{} of", a.width, a.height, r.width,
                             r.height),
                 "compare images of the same size; lemma render takes --size");
  }
  if (image.linear != reference.linear) {
    throw refuse(fmt::format("{} cannot be compared with the {} of", image.linear ? "radiance" : "a picture",
                             reference.linear ? "radiance" : "picture"),
                 "compare two .exr files, or two pictures");
  }
  if (options.statistical && (!image.variance || !reference.variance)) {
    throw std::runtime_error(fmt::format(
        "{}: error: no layer \"variance\", which --statistical needs\n  hint: .exr files that lemma render "
        "writes with --spp 2 or more have it",
        (image.variance ? options.reference : options.image).string()));
  }
}

double mean_of(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

NoisyImage noisy(const ReadImage& read) {
  return {read.image, *read.variance, std::max(1, read.parts - 1)};
}

Comparison compare(const CompareOptions& options, const ReadImage& image, const ReadImage& reference) {
  const Image &a = image.image, &r = reference.image;
  Comparison c;
  c.errors = error_figures(a, r);
  c.flip = mean_of(image.linear ? hdr_flip(a, r) : ldr_flip(a, r));
  if (reference.variance) c.noise = reference_noise(r, *reference.variance);
  c.largest = largest_differences(a, r, options.largest);
  if (image.variance && reference.variance) {
    const StatisticalResult test = test_equal_means(noisy(image), noisy(reference), options.test);
    c.standard_error = test.standard_error;
    if (options.statistical) c.test = test;
  }
  for (const FigureLimit& limit : options.limits) {
    if (figure_of(c, limit.figure) > limit.most) c.exceeded.push_back(limit);
  }
  return c;
}

/// @return the scale of its colours, if it has any
std::optional<double> write_difference(const CompareOptions& options, const Image& image,
                                       const Image& reference) {
  const std::filesystem::path& path = options.output;
  const Metadata metadata = {{"Software", "Lemma " LEMMA_VERSION}, {"DateTime", ""}};
  if (holds_linear_floats(path)) {
    write_image(path, signed_difference(image, reference), nullptr, {}, metadata);
    return std::nullopt;
  }
  const ToneMap as_is{ToneCurve::gamma, 0, 1, 1};
  const double scale = options.scale ? *options.scale : difference_scale(image, reference);
  write_image(path, false_color(image, reference, scale), nullptr, as_is, metadata);
  return scale;
}

}  // namespace

CLI::App* add_compare_command(CLI::App& app, CompareOptions& o) {
  CLI::App* compare = app.add_subcommand("compare", "Error figures of an image against a reference");
  constexpr const char* expected = "an image file";
  add_file(*compare, {.flag = "IMAGE", .type = "FILE", .expected = expected, .help = "The image"},
           [&o](const auto& path) { o.image = path; })
      ->required();
  add_file(*compare,
           {.flag = "REFERENCE", .type = "FILE", .expected = expected, .help = "What it should look like"},
           [&o](const auto& path) { o.reference = path; })
      ->required();
  add_file(
      *compare,
      {.flag = "-o,--output",
       .type = "FILE",
       .expected = "an image file's name, with its ending",
       .help = "Difference image to write: .exr holds IMAGE - REFERENCE, a picture its luminance in colours"},
      [&o](const auto& path) { o.output = path; });
  add_value(
      *compare,
      {.flag = "--scale",
       .type = "X",
       .expected = "a number above 0",
       .help = "Difference of luminance at which the colours of -o are full, so that pictures can share "
               "a scale. Default: what 99 % of its pixels stay below"},
      into(o.scale, parse_positive));
  add_file(*compare,
           {.flag = "--json", .type = "FILE.json", .expected = "a file's name", .help = "Write all as JSON"},
           [&o](const auto& path) { o.json = path; });
  add_value(*compare,
            {.flag = "--fail-above",
             .type = "NAME=X",
             .expected = fmt::format("NAME=X with X at least 0 and NAME one of: {}", list_figures()),
             .help = "Exit with 3 if the figure is above X; may be given several times",
             .repeats = true},
            [&o](const std::string& text) {
              const auto limit = parse_limit(text);
              if (limit) o.limits.push_back(*limit);
              return limit.has_value();
            });
  add_test_options(*compare, o);
  add_integer(*compare, "--largest", o.largest, 0, 1000000, "Pixels to show, of those that differ most");
  compare->add_flag("-q,--quiet", o.quiet, "Print nothing but errors");
  compare->footer(
      "rmse: root of the mean of (I - R)^2; relmse: mean of (I - R)^2 / (R^2 + 0.01), trimmed: without\n"
      "the 0.1 % of the pixels that have most of it; smape: mean of 2 |I - R| / (|I| + |R|); flip: mean\n"
      "of FLIP, HDR-FLIP for radiance, at 67 pixels a degree. Pictures are compared by their values in\n"
      "[0, 1].\n\n"
      "--json: the figures by these names; settings (what each depends on: relMSE's epsilon 0.01, the\n"
      "part left out, pixels a degree, exposures in stops); limits (of --fail-above: figure, most,\n"
      "value, exceeded); statistical (different, false_alarm, block, z and limits); difference_image\n"
      "(of -o: file, of, and for pictures the scale and the colour of each difference, sRGB from 0 to\n"
      "1); mean_difference; largest_differences.");
  return compare;
}

ExitCode run_compare(const CompareOptions& options) {
  if (!options.output.empty()) check_writable(options.output);
  if (!options.json.empty()) check_whole_file(options.json);
  const ReadImage image = read_image(options.image), reference = read_image(options.reference);
  require_comparable(options, image, reference);
  Comparison comparison = compare(options, image, reference);
  if (!options.output.empty()) {
    comparison.color_scale = write_difference(options, image.image, reference.image);
  }
  if (!options.json.empty()) {
    write_whole_file(options.json, comparison_json(options, image, reference, comparison));
  }
  if (!options.quiet) fmt::print("{}", comparison_text(options, image, reference, comparison));
  const bool failed = !comparison.exceeded.empty() || (comparison.test && comparison.test->different());
  return failed ? kComparisonFailed : kDone;
}

}  // namespace lemma
