#include "src/scene/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "src/scene/utf8.h"

namespace lemma {
namespace {

void require_regular_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw SceneError({path}, "no such file", "check the name");
  if (!std::filesystem::is_regular_file(status)) throw SceneError({path}, "this is no file", "name a file");
}

/// The file's size, if it may be read.
std::size_t size_within(const std::filesystem::path& path, std::uint64_t most_bytes) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw SceneError({path}, "the file cannot be read", "check its permissions");
  if (size > most_bytes) {
    throw SceneError({path},
                     fmt::format("the file has {:.1f} MB; at most {:.1f} MB are read",
                                 static_cast<double>(size) / 1e6, static_cast<double>(most_bytes) / 1e6),
                     "check that it is the right file, or divide it");
  }
  return static_cast<std::size_t>(size);
}

int line_of(std::string_view text, std::size_t at) {
  return static_cast<int>(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace

std::string checked_text(const std::filesystem::path& path, std::string text, Warnings& warnings) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  if (text.empty()) throw SceneError({path}, "the file is empty", "");
  if (const std::size_t zero = text.find('\0'); zero != text.npos) {
    throw SceneError({path, line_of(text, zero)}, "the file holds zero bytes: it is no text in UTF-8",
                     "save it as UTF-8, without compression");
  }
  if (const auto bad = find_invalid_utf8(text)) {
    warn(warnings, {path, line_of(text, *bad)}, "this is no UTF-8; names are compared byte by byte");
  }
  return text;
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t most_bytes, Warnings& warnings) {
  require_regular_file(path);
  std::string text(size_within(path, most_bytes), '\0');
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw SceneError({path}, "the file cannot be opened", "check its permissions");
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw SceneError({path}, "the file cannot be read to its end", "");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return checked_text(path, std::move(text), warnings);
}

}  // namespace lemma
