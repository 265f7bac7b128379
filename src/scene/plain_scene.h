#pragma once

#include "src/scene/read_xml.h"

namespace lemma {

/// Whether a file with the ending .xml is none, but the plain text that some scenes of the course have in its
/// place: its first line that says something starts with no '<'.
[[nodiscard]] bool is_plain_scene(std::string_view text);

/// Reads camera and lights from plain text, a property a line, '#' before comments:
///   width 500
///   eye 0 1 5
///   mtlname Light 30 30 30
/// Lines of other words are warned of. Of two lights with the same material the later one counts.
/// @throw SceneError with the line for values that make no image, and for a camera that lacks one
[[nodiscard]] XmlScene parse_plain_scene(const std::filesystem::path& path, std::string_view text,
                                         Warnings& warnings);

}  // namespace lemma
