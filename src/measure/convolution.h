#pragma once

#include <vector>

namespace lemma {

/// One number a pixel, row by row.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// Weights of the 2 r + 1 neighbours, the middle one at index r.
using Kernel = std::vector<float>;

/// Weighted sums over a pixel's neighbours in its row, then in its column; beyond the border the plane goes
/// on with the value at it.
[[nodiscard]] Plane convolve(const Plane& plane, const Kernel& along_rows, const Kernel& along_columns);

}  // namespace lemma
