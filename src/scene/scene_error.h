#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace lemma {

/// Where in a file something was found. Line and column count from 1; 0: not known.
struct FilePosition {
  std::filesystem::path file;
  int line = 0, column = 0;
};

/// "file", "file:line" or "file:line:column".
[[nodiscard]] std::string to_string(const FilePosition& position);

/// Bad input. what() is one message for the user:
///   file:line:column: error: what
///     hint: what instead
class SceneError : public std::runtime_error {
 public:
  SceneError(const FilePosition& where, const std::string& what, const std::string& hint);
};

}  // namespace lemma
