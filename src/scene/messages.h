#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/scene/scene_error.h"

namespace lemma {

/// What a reader met and went on from, in the order met.
using Warnings = std::vector<std::string>;

/// Appends "file:line:column: warning: what", without the parts of `where` that are not known.
void warn(Warnings& warnings, const FilePosition& where, std::string_view what);

/// `text` in quotes, fit for a message: a long one is cut, control characters become blanks, and what is no
/// UTF-8 becomes '?'.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// "a, b, c"; after eight names "and 12 more".
[[nodiscard]] std::string join_names(const std::vector<std::string>& names);

}  // namespace lemma
