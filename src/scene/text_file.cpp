#include "src/scene/text_file.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "src/scene/scene_error.h"

namespace lemma {
namespace {

void require_regular_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw SceneError({path}, "no such file", "check the name");
  if (!std::filesystem::is_regular_file(status)) throw SceneError({path}, "this is no file", "name a file");
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
  require_regular_file(path);
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  if (!stream) throw SceneError({path}, "the file cannot be opened", "check its permissions");
  content << stream.rdbuf();
  if (stream.bad()) throw SceneError({path}, "the file cannot be read to its end", "");

  std::string text = std::move(content).str();
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  if (text.empty()) throw SceneError({path}, "the file is empty", "");
  const auto zero = std::find(text.begin(), text.end(), '\0');
  if (zero != text.end()) {
    const auto line = 1 + std::count(text.begin(), zero, '\n');
    throw SceneError({path, static_cast<int>(line)}, "the file holds zero bytes: it is no text in UTF-8",
                     "save it as UTF-8, without compression");
  }
  return text;
}

}  // namespace lemma
