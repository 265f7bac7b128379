#include "src/scene/messages.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/scene/utf8.h"

namespace lemma {

void warn(Warnings& warnings, const FilePosition& where, std::string_view what) {
  warnings.push_back(fmt::format("{}: warning: {}", to_string(where), what));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::size_t end = std::min(kLongest, text.size());
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; };
  while (end < text.size() && end > 0 && continues(text[end])) --end;  // not within a character
  std::string shown(text.substr(0, end));
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  std::replace_if(shown.begin(), shown.end(), is_control, ' ');
  while (const auto bad = find_invalid_utf8(shown)) shown[*bad] = '?';
  return fmt::format("\"{}{}\"", shown, end < text.size() ? "..." : "");
}

std::string join_names(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 8;
  const std::size_t shown = std::min(kShown, names.size());
  std::string list =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (shown < names.size()) list += fmt::format(" and {} more", names.size() - shown);
  return list;
}

}  // namespace lemma
