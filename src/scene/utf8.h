#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace lemma {

/// Where the first byte stands that belongs to no well-formed UTF-8 sequence (Unicode 15, table 3-7); nothing
/// if all do.
[[nodiscard]] std::optional<std::size_t> find_invalid_utf8(std::string_view text);

}  // namespace lemma
