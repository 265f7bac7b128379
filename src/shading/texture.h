#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "src/core/rgb.h"
#include "src/core/vec.h"

namespace lemma {

/// Why an image cannot be a texture, in one line.
class TextureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An image on a surface: linear colours, repeated without end, interpolated bilinearly between the centres
/// of its pixels. Immutable; lookups are thread-safe and depend on nothing but (u, v).
class Texture {
 public:
  /// Reads an image file of any format that OpenImageIO knows. Pixels of whole numbers are taken for sRGB,
  /// unless the file says that they are linear, those of floating point for linear colours (NaN and negative
  /// values become 0). A single channel is a grey; alpha is left out.
  /// @throw TextureError if the file cannot be read, or needs more than a part of the machine's memory
  explicit Texture(const std::filesystem::path& file);

  /// @param uv  finite; (0, 0) is the lower left corner of the image, (1, 1) the upper right
  [[nodiscard]] Rgb at(const Vec2& uv) const;

  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Pixels;
  std::shared_ptr<const Pixels> pixels_;  // copies share them
};

}  // namespace lemma
