#include "src/render/image_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

namespace lemma {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

bool holds_linear_floats(const fs::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".exr" || extension == ".hdr" || extension == ".pfm";
}

/// Beside the target, with its ending (which tells the format), and no other process's.
fs::path temporary_name(const fs::path& path) {
  return path.parent_path() /
         fmt::format(".{}.{}.tmp{}", path.stem().string(), ::getpid(), path.extension().string());
}

std::unique_ptr<OIIO::ImageOutput> open_format(const fs::path& path) {
  auto output = OIIO::ImageOutput::create(path.string());
  if (!output) {
    throw ImageFileError(fmt::format(
        "{}: error: no image format for the ending \"{}\"\n  hint: use .exr for linear radiance, or "
        ".png, .jpg, .tif ... for a picture",
        path.string(), path.extension().string()));
  }
  return output;
}

OIIO::ImageSpec make_spec(const Image& image, bool linear, const Metadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, 3, linear ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
  spec.attribute("compression", linear ? "zip" : "");
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  return spec;
}

void write_file(const fs::path& path, const Image& image, const Metadata& metadata) {
  const auto output = open_format(path);
  const bool linear = holds_linear_floats(path);
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  const bool ok = output->open(path.string(), make_spec(image, linear, metadata)) &&
                  output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) && output->close();
  if (!ok) throw ImageFileError(output->geterror());
}

}  // namespace

void check_writable(const fs::path& path) {
  (void)open_format(path);
  const fs::path temporary = temporary_name(path);
  const bool creatable = std::ofstream(temporary).good();
  std::error_code ignored;
  fs::remove(temporary, ignored);
  if (!creatable) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    throw ImageFileError(
        fmt::format("{}: error: cannot be written: the folder {} does not exist or takes no files\n"
                    "  hint: make the folder, or choose another name with -o",
                    path.string(), folder.string()));
  }
}

void write_image(const fs::path& path, const Image& image, const ToneMap& tone_map,
                 const Metadata& metadata) {
  const fs::path temporary = temporary_name(path);
  try {
    write_file(temporary, holds_linear_floats(path) ? image : apply(tone_map, image), metadata);
    fs::rename(temporary, path);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw ImageFileError(fmt::format("{}: error: cannot be written: {}", path.string(), error.what()));
  }
}

}  // namespace lemma
