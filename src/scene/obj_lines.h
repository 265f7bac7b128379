#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lemma {

/// The text of an OBJ or MTL file, made plain for readers that are easily upset: each line ends in \n (from
/// \r\n or \r), has neither comment nor blanks at its ends, and one blank after its keyword; a line continued
/// by a backslash is joined, and blank lines follow it, so that line numbers stay those of the file. A '#'
/// starts a comment at the start of a line, after a blank, and anywhere on an `f` line; elsewhere it may be
/// part of a name.
[[nodiscard]] std::string plain_lines(std::string_view text);

/// One line: `keyword rest`.
struct ObjLine {
  std::string_view keyword, rest;
  int number = 0;  // counts from 1
};

/// Walks through the lines of a text that plain_lines() made, leaving out the empty ones.
class LineCursor {
 public:
  /// @param plain  outlives the cursor and its lines
  explicit LineCursor(std::string_view plain) : rest_(plain) {}

  [[nodiscard]] std::optional<ObjLine> next();

 private:
  std::string_view rest_;
  int number_ = 0;
};

}  // namespace lemma
