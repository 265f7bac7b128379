#include "src/render/read_image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "src/render/image_layers.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

std::runtime_error bad_image(const fs::path& path, std::string_view what, std::string_view hint) {
  return std::runtime_error(fmt::format("{}: error: {}\n  hint: {}", path.string(), what, hint));
}

std::unique_ptr<OIIO::ImageInput> open(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw bad_image(path, "no such file", "check the name");
  if (fs::is_directory(path, error)) throw bad_image(path, "this is a folder", "name an image file");
  auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    throw bad_image(path, fmt::format("no image can be read from it: {}", OIIO::geterror()),
                    "name an image as lemma render writes it: .exr, .png ...");
  }
  if (input->spec().deep || input->spec().depth > 1) {
    throw bad_image(path, "the image is deep or has several slices", "name a flat image");
  }
  return input;
}

/// Places of three channels among those of the file; -1 for one that is not there.
std::array<int, 3> find_channels(const OIIO::ImageSpec& spec, const std::array<const char*, 3>& names) {
  std::array<int, 3> places{};
  std::ranges::transform(names, places.begin(), [&](const char* name) { return spec.channelindex(name); });
  return places;
}

bool has_none(const std::array<int, 3>& places) {
  return std::ranges::all_of(places, [](int place) { return place < 0; });
}

bool has_all(const std::array<int, 3>& places) {
  return std::ranges::all_of(places, [](int place) { return place >= 0; });
}

std::string list_channels(const OIIO::ImageSpec& spec) {
  std::string names;
  for (const std::string& name : spec.channelnames) names.append(names.empty() ? "" : ", ").append(name);
  return names;
}

Image pick(const OIIO::ImageSpec& spec, const std::vector<float>& values, const std::array<int, 3>& places) {
  const auto stride = static_cast<std::size_t>(spec.nchannels);
  Image image{spec.width, spec.height, std::vector<Rgb>(values.size() / stride)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float* pixel = &values[i * stride];
    image.pixels[i] = {pixel[places[0]], pixel[places[1]], pixel[places[2]]};
  }
  return image;
}

void require_variances(const fs::path& path, const Image& variance) {
  const auto bad = std::ranges::find_if(variance.pixels, [](const Rgb& v) {
    return std::min({v.r, v.g, v.b}) < 0;
  });
  if (bad == variance.pixels.end()) return;
  const auto index = static_cast<int>(bad - variance.pixels.begin());
  throw bad_image(
      path,
      fmt::format("the layer variance is negative at {},{}", index % variance.width, index / variance.width),
      "expected the variance of each value's mean, as lemma render writes it");
}

void require_finite(const fs::path& path, const Image& image, std::string_view layer) {
  const auto finite = [](const Rgb& c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
  };
  const auto bad = std::ranges::find_if_not(image.pixels, finite);
  if (bad == image.pixels.end()) return;
  const auto index = static_cast<int>(bad - image.pixels.begin());
  const auto count =
      image.pixels.size() - static_cast<std::size_t>(std::ranges::count_if(image.pixels, finite));
  throw bad_image(path,
                  fmt::format("{} of {} pixels not finite{}, the first at {},{}", count, image.pixels.size(),
                              layer, index % image.width, index / image.width),
                  "an image with NaN or infinite values has no error figures");
}

}  // namespace

ReadImage read_image(const fs::path& path) {
  const auto input = open(path);
  const OIIO::ImageSpec spec = input->spec();
  const auto color = find_channels(spec, kColorChannels);
  const auto variance = find_channels(spec, kVarianceChannels);
  if (!has_all(color) || (!has_all(variance) && !has_none(variance))) {
    throw bad_image(path, fmt::format("it has the channels {}", list_channels(spec)),
                    "expected R, G, B, and all or none of variance.R, variance.G, variance.B");
  }
  std::vector<float> values(static_cast<std::size_t>(spec.image_pixels()) *
                            static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) {
    throw bad_image(path, fmt::format("it cannot be read to its end: {}", input->geterror()),
                    "the file may be broken; write it again");
  }
  ReadImage read;
  read.image = pick(spec, values, color);
  read.linear = spec.format.is_floating_point();
  read.seed = spec.get_string_attribute(kSeedAttribute);
  require_finite(path, read.image, "");
  if (has_all(variance)) {
    read.variance = pick(spec, values, variance);
    require_finite(path, *read.variance, " in the layer variance");
    require_variances(path, *read.variance);
    read.parts = spec.get_int_attribute(kPartsAttribute, 0);
  }
  return read;
}

}  // namespace lemma
