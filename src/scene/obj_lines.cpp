#include "src/scene/obj_lines.h"

#include <algorithm>
#include <limits>

namespace lemma {
namespace {

constexpr std::string_view kBlanks = " \t";

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trim(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

bool is_face(std::string_view line) {
  return line.size() > 1 && line[0] == 'f' && is_blank(line[1]);
}

/// @param face  whether the line belongs to a face, where no '#' can be part of a name
std::string_view without_comment(std::string_view line, bool face) {
  for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1)) {
    if (at == 0 || face || is_blank(line[at - 1])) return trim(line.substr(0, at));
  }
  return line;
}

}  // namespace

std::string_view LineCursor::take_line() {
  if (taken_ < std::numeric_limits<int>::max()) ++taken_;
  std::string_view line = rest_.substr(0, rest_.find('\n'));
  rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
  if (const std::size_t cr = line.find('\r'); cr != line.npos) {
    const std::size_t after = line.size() - cr - 1;
    if (after > 0) {  // what follows is a line of its own
      const char* const next = line.data() + cr + 1;
      rest_ = {next, static_cast<std::size_t>(rest_.data() + rest_.size() - next)};
    }
    line = line.substr(0, cr);
  }
  return trim(line);
}

/// A line that ends in a backslash, and those that it goes on in.
std::string_view LineCursor::take_joined(std::string_view first) {
  joined_.clear();
  std::string_view line = first;
  while (line.ends_with('\\')) {
    joined_.append(line.substr(0, line.size() - 1)).append(1, ' ');
    line = without_comment(take_line(), is_face(joined_));
  }
  return trim(joined_.append(line));
}

std::optional<ObjLine> LineCursor::next() {
  while (!rest_.empty()) {
    std::string_view line = take_line();
    const int number = taken_;
    line = without_comment(line, is_face(line));
    if (line.ends_with('\\')) line = take_joined(line);
    if (line.empty()) continue;
    const std::size_t keyword = std::min(line.find_first_of(kBlanks), line.size());
    return ObjLine{line.substr(0, keyword), trim(line.substr(keyword)), number};
  }
  return std::nullopt;
}

}  // namespace lemma
