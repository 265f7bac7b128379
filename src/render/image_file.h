#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "src/render/film.h"
#include "src/render/tone_map.h"
#include "src/render/whole_file.h"

namespace lemma {

/// Names and values kept in an image file's header.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Whether files of this ending hold linear floats: EXR and HDR. All others hold values for the screen.
[[nodiscard]] bool holds_linear_floats(const std::filesystem::path& path);

/// Checks before a long rendering that the image could be written: the format is known by the name's ending
/// and check_whole_file() passes.
/// @throw FileError
void check_writable(const std::filesystem::path& path);

/// Writes the image in the format that the name's ending tells: EXR and HDR hold linear floats, all
/// others the tone-mapped 8-bit picture. The file appears under its name only when it is whole.
/// @param variance  of each value of the image, for the layer "variance" of EXR files; null: none
/// @throw FileError
void write_image(const std::filesystem::path& path, const Image& image, const Image* variance,
                 const ToneMap& tone_map, const Metadata& metadata);

}  // namespace lemma
