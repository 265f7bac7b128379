#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "src/render/film.h"
#include "src/render/tone_map.h"

namespace lemma {

/// An image file cannot be written or read; what() is the message for the user.
class ImageFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Names and values kept in an image file's header.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Checks before a long rendering that the image could be written: the format is known by the name's ending
/// and the folder takes new files.
/// @throw ImageFileError
void check_writable(const std::filesystem::path& path);

/// Writes the image in the format that the name's ending tells: EXR, HDR and PFM hold linear floats, all
/// others the tone-mapped 8-bit picture. The file appears under its name only when it is whole: it is written
/// under a temporary name beside it and renamed.
/// @throw ImageFileError
void write_image(const std::filesystem::path& path, const Image& image, const ToneMap& tone_map,
                 const Metadata& metadata);

}  // namespace lemma
