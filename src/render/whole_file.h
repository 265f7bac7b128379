#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace lemma {

/// A file cannot be written; what() is the message for the user.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Checks before a long rendering that write_whole_file(path, ...) will be able to write: that the path is no
/// folder and not write-protected, and that its folder takes new files.
/// @throw FileError
void check_whole_file(const std::filesystem::path& path);

/// Writes a file that appears under its name only when it is whole: it is written under a temporary name
/// beside it and renamed. Links are followed; to a device or pipe the bytes go as they come.
/// @throw FileError
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lemma
