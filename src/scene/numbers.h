#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace lemma {

/// No coordinate of a scene may be larger: 1e18^2 = 1e36 still fits a float, so that no length overflows.
inline constexpr double kMaxCoordinate = 1e18;

/// The numbers of `text`, separated by blanks, line breaks or one comma. "nan" and "inf" count as numbers.
/// Nothing if anything else stands there, or a number that no double can hold. Does not depend on the locale.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace lemma
