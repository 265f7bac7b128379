#include "src/render/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

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

OIIO::ImageSpec make_spec(const Image& image, const fs::path& path, const Metadata& metadata) {
  const bool linear = holds_linear_floats(path);
  OIIO::ImageSpec spec(image.width, image.height, 3, linear ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  // In TIFF it makes an Exif directory, which OpenImageIO 2.4 does not write to memory; TIFF is sRGB without.
  if (!lower_extension(path).starts_with(".tif")) {
    spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
  }
  spec.attribute("compression", linear ? "zip" : "");
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  return spec;
}

std::vector<unsigned char> encode(const fs::path& path, const Image& image, const Metadata& metadata) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = open_format(path);
  output->set_ioproxy(&memory);
  const bool ok = output->open(path.string(), make_spec(image, path, metadata)) &&
                  output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) && output->close();
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

void write_image(const fs::path& path, const Image& image, const ToneMap& tone_map,
                 const Metadata& metadata) {
  const auto bytes = encode(path, holds_linear_floats(path) ? image : apply(tone_map, image), metadata);
  write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace lemma
