#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lemma {

/// One line: `keyword rest`. No blanks stand around them. Valid until the next line is asked for.
struct ObjLine {
  std::string_view keyword, rest;
  int number = 0;  // counts from 1; stays at 2^31 - 1 from there on
};

/// Walks through the lines of an OBJ or MTL file, leaving out the empty ones. Lines end in \n, \r\n or \r; a
/// backslash continues a line on the next one, and the number is that of the first. A '#' starts a comment at
/// the start of a line, after a blank, and anywhere on an `f` line; elsewhere it may be part of a name.
class LineCursor {
 public:
  /// @param text  outlives the cursor and its lines
  explicit LineCursor(std::string_view text) : rest_(text) {}

  [[nodiscard]] std::optional<ObjLine> next();

 private:
  std::string_view take_line();
  std::string_view take_joined(std::string_view first);

  std::string_view rest_;
  int taken_ = 0;       // lines of the text so far
  std::string joined_;  // a continued line
};

}  // namespace lemma
