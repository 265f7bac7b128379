#pragma once

#include <string>
#include <string_view>

namespace lemma {

/// The file name of a map_Kd line, which may hold blanks: what stands behind the options, such as
/// `-s 2 2 1 -clamp on wood 5.jpg`.
[[nodiscard]] std::string texture_name(std::string_view line);

}  // namespace lemma
