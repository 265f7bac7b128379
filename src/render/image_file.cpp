#include "src/render/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "src/render/image_layers.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// A writer into memory. Written straight to a file, some formats lose what does not fit on the disk without
/// a word, and JPEG ends the program.
std::unique_ptr<OIIO::ImageOutput> open_format(const fs::path& path) {
  auto output = OIIO::ImageOutput::create(path.string());
  if (!output || output->supports("ioproxy") == 0) {
    (void)OIIO::geterror();  // left there, some versions print it when the program ends
    throw FileError(fmt::format(
        "{}: error: no image format for the ending \"{}\"\n  hint: use .exr for linear radiance, or "
        ".png, .jpg, .tif ... for a picture",
        path.string(), path.extension().string()));
  }
  return output;
}

OIIO::ImageSpec make_spec(const Image& image, bool with_variance, const fs::path& path,
                          const Metadata& metadata) {
  const bool linear = holds_linear_floats(path);
  OIIO::ImageSpec spec(image.width, image.height, with_variance ? 6 : 3,
                       linear ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  if (with_variance) {
    spec.channelnames.assign(kColorChannels.begin(), kColorChannels.end());
    spec.channelnames.insert(spec.channelnames.end(), kVarianceChannels.begin(), kVarianceChannels.end());
  }
  // In TIFF it makes an Exif directory, which OpenImageIO 2.4 does not write to memory; TIFF is sRGB without.
  if (!lower_extension(path).starts_with(".tif")) {
    spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
  }
  spec.attribute("compression", linear ? "zip" : "");
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  return spec;
}

/// The values in the order of the file's channels.
std::vector<Rgb> interleave(const Image& image, const Image& variance) {
  std::vector<Rgb> values;
  values.reserve(2 * image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    values.push_back(image.pixels[i]);
    values.push_back(variance.pixels[i]);
  }
  return values;
}

std::vector<unsigned char> encode(const fs::path& path, const Image& image, const Image* variance,
                                  const Metadata& metadata) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  const std::vector<Rgb> layers = variance == nullptr ? std::vector<Rgb>() : interleave(image, *variance);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = open_format(path);
  output->set_ioproxy(&memory);
  const bool ok =
      output->open(path.string(), make_spec(image, variance != nullptr, path, metadata)) &&
      output->write_image(OIIO::TypeDesc::FLOAT, variance == nullptr ? image.pixels.data() : layers.data()) &&
      output->close();
  if (!ok)
    throw FileError(fmt::format("{}: error: cannot be written: {}", path.string(), output->geterror()));
  return bytes;
}

}  // namespace

bool holds_linear_floats(const fs::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".exr" || extension == ".hdr";
}

void check_writable(const fs::path& path) {
  (void)open_format(path);
  check_whole_file(path);
}

void write_image(const fs::path& path, const Image& image, const Image* variance, const ToneMap& tone_map,
                 const Metadata& metadata) {
  const bool layered = variance != nullptr && lower_extension(path) == ".exr";
  const auto bytes = encode(path, holds_linear_floats(path) ? image : apply(tone_map, image),
                            layered ? variance : nullptr, metadata);
  write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace lemma
