#include "src/scene/obj_lines.h"

#include <algorithm>

namespace lemma {
namespace {

constexpr std::string_view kBlanks = " \t";

/// Cuts the first line off `text`, without its end.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
  return line;
}

std::string_view trim(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  return line.substr(0, line.find_last_not_of(kBlanks) + 1);
}

bool is_face(std::string_view line) {
  return line.starts_with("f ") || line.starts_with("f\t");
}

/// @param face  whether the line belongs to a face, where no '#' can be part of a name
std::string_view without_comment(std::string_view line, bool face) {
  for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1)) {
    if (at == 0 || face || kBlanks.find(line[at - 1]) != kBlanks.npos) return trim(line.substr(0, at));
  }
  return line;
}

void append_plain(std::string& out, std::string_view line) {
  const std::size_t keyword = std::min(line.find_first_of(kBlanks), line.size());
  out.append(line.substr(0, keyword));
  if (keyword < line.size()) out.append(1, ' ').append(trim(line.substr(keyword)));
}

}  // namespace

std::string plain_lines(std::string_view text) {
  std::string out, joined;
  out.reserve(text.size() + 1);
  std::size_t continued = 0;
  while (!text.empty()) {
    std::string_view line = trim(take_line(text));
    line = without_comment(line, is_face(continued > 0 ? joined : line));
    const bool goes_on = line.ends_with('\\');
    if (goes_on) line.remove_suffix(1);
    if (goes_on || continued > 0) {
      joined.append(line).append(1, ' ');
      line = trim(joined);
    }
    if (goes_on && !text.empty()) {
      ++continued;
      continue;
    }
    append_plain(out, line);
    out.append(1 + continued, '\n');
    joined.clear();
    continued = 0;
  }
  return out;
}

std::optional<ObjLine> LineCursor::next() {
  while (!rest_.empty()) {
    const std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    ++number_;
    if (line.empty()) continue;
    const std::size_t keyword = std::min(line.find(' '), line.size());
    return ObjLine{line.substr(0, keyword), line.substr(std::min(keyword + 1, line.size())), number_};
  }
  return std::nullopt;
}

}  // namespace lemma
