#pragma once

#include <array>

#include "src/core/rgb.h"

namespace lemma {

/// The channels in double, to loop over them.
[[nodiscard]] inline std::array<double, 3> channels(const Rgb& c) {
  return {double{c.r}, double{c.g}, double{c.b}};
}

}  // namespace lemma
