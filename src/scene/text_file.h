#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "src/scene/messages.h"

namespace lemma {

/// More than this no XML and no MTL needs.
inline constexpr std::uint64_t kMostDescriptionBytes = 64'000'000;

/// All of a text file, without a byte order mark. A file that is no UTF-8 is warned of, and read as it is: in
/// names and comments any bytes may stand.
/// @param most_bytes  a larger file is refused before memory is taken for it
/// @throw SceneError if it is missing, no file, unreadable, too large, empty, or holds zero bytes (UTF-16,
///        binary data)
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path, std::uint64_t most_bytes,
                                         Warnings& warnings);

/// The same checks for a text that is in memory already.
/// @param path  what messages call it
[[nodiscard]] std::string checked_text(const std::filesystem::path& path, std::string text,
                                       Warnings& warnings);

}  // namespace lemma
