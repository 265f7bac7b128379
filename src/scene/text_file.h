#pragma once

#include <filesystem>
#include <string>

namespace lemma {

/// All of a text file, without a byte order mark.
/// @throw SceneError if it is missing, no file, unreadable, empty, or holds zero bytes (UTF-16, binary data)
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

}  // namespace lemma
