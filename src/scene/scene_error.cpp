#include "src/scene/scene_error.h"

#include <fmt/format.h>

namespace lemma {
namespace {

std::string message(const FilePosition& where, const std::string& what, const std::string& hint) {
  const std::string error = fmt::format("{}: error: {}", to_string(where), what);
  return hint.empty() ? error : fmt::format("{}\n  hint: {}", error, hint);
}

}  // namespace

std::string to_string(const FilePosition& position) {
  std::string text = position.file.string();
  if (position.line > 0) text += fmt::format(":{}", position.line);
  if (position.line > 0 && position.column > 0) text += fmt::format(":{}", position.column);
  return text;
}

SceneError::SceneError(const FilePosition& where, const std::string& what, const std::string& hint)
    : std::runtime_error(message(where, what, hint)) {}

}  // namespace lemma
