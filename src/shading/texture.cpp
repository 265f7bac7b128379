#include "src/shading/texture.h"

#include <Imath/half.h>
#include <OpenImageIO/color.h>
#include <OpenImageIO/imagebuf.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "src/core/machine.h"

namespace lemma {

/// Three channels of half floats: they hold sRGB's 8 bits more finely than those were rounded.
struct Texture::Pixels {
  OIIO::ImageBuf buffer;
};

namespace {

constexpr int kChannels = 3;
constexpr std::uint64_t kBytesAPixel = 24;  // while reading: as read, as float, as half
constexpr std::uint64_t kMemoryShare = 8;   // one texture may take this part of the machine's

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

void require_room(const OIIO::ImageSpec& spec) {
  const auto pixels = static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  if (spec.width <= 0 || spec.height <= 0) throw TextureError("it has no pixels");
  if (pixels > machine_memory() / kMemoryShare / kBytesAPixel) throw TextureError("it is too large");
}

bool is_linear(const OIIO::ImageSpec& spec) {
  return spec.format.is_floating_point() || spec.get_string_attribute("oiio:ColorSpace") == "Linear";
}

/// The first three channels of an image as linear colours; a single one three times.
OIIO::ImageBuf linear_colours(const OIIO::ImageBuf& image, bool linear) {
  const OIIO::ImageSpec& spec = image.spec();
  const bool grey = spec.nchannels < kChannels;
  OIIO::ImageBuf colours(OIIO::ImageSpec(spec.width, spec.height, kChannels, OIIO::TypeDesc::HALF));
  OIIO::ImageBuf::ConstIterator<float> from(image);
  // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Assign): within the library's iterator
  for (OIIO::ImageBuf::Iterator<half> to(colours); !to.done(); ++to, ++from) {
    for (int c = 0; c < kChannels; ++c) {
      const float value = from[grey ? 0 : c];
      const float finite = value > 0 ? std::min(value, 65504.0f) : 0.0f;  // the largest half; NaN becomes 0
      to[c] = linear ? finite : OIIO::sRGB_to_linear(finite);
    }
  }
  return colours;
}

}  // namespace

Texture::Texture(const std::filesystem::path& file) {
  OIIO::ImageBuf image(file.string());
  if (!image.init_spec(file.string(), 0, 0)) throw TextureError(first_line(image.geterror()));
  require_room(image.spec());
  const bool linear = is_linear(image.spec());  // before it becomes one of floats
  if (!image.read(0, 0, true, OIIO::TypeDesc::FLOAT)) throw TextureError(first_line(image.geterror()));
  pixels_ = std::make_shared<const Pixels>(Pixels{linear_colours(image, linear)});
}

Rgb Texture::at(const Vec2& uv) const {
  const float u = uv.x - std::floor(uv.x), v = uv.y - std::floor(uv.y);
  float colour[kChannels] = {0, 0, 0};
  pixels_->buffer.interppixel_NDC(u, 1 - v, colour, OIIO::ImageBuf::WrapPeriodic);
  return {colour[0], colour[1], colour[2]};
}

int Texture::width() const {
  return pixels_->buffer.spec().width;
}

int Texture::height() const {
  return pixels_->buffer.spec().height;
}

std::size_t Texture::memory_bytes() const {
  return pixels_->buffer.spec().image_bytes();
}

}  // namespace lemma
