#pragma once

#include <filesystem>
#include <string_view>

namespace lemma {

/// Checks before a long rendering that a file which may stand where an output will be written may be
/// replaced: that it is no folder and not write-protected.
/// @throw std::runtime_error
void check_replaceable(const std::filesystem::path& path);

/// Checks before a long rendering that write_text_file(path, ...) will be able to write.
/// @throw std::runtime_error
void check_text_file(const std::filesystem::path& path);

/// Writes a text file that appears under its name only when it is whole; to a device or pipe, as it comes.
/// @throw std::runtime_error
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace lemma
