#include "src/measure/convolution.h"

#include <algorithm>

#include "src/core/parallel.h"

namespace lemma {
namespace {

std::size_t at(const Plane& plane, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(plane.width) + static_cast<std::size_t>(x);
}

Plane convolve_rows(const Plane& plane, const Kernel& kernel) {
  const auto radius = static_cast<std::size_t>(kernel.size() / 2),
             width = static_cast<std::size_t>(plane.width);
  Plane sum{plane.width, plane.height, std::vector<float>(plane.values.size())};
  parallel_for(static_cast<std::size_t>(plane.height), [&](std::size_t y) {
    const float* row = &plane.values[y * width];
    std::vector<float> padded(width + 2 * radius);
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, row[width - 1]);
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      for (std::size_t x = 0; x < width; ++x) sum.values[y * width + x] += kernel[k] * padded[x + k];
    }
  });
  return sum;
}

Plane convolve_columns(const Plane& plane, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Plane sum{plane.width, plane.height, std::vector<float>(plane.values.size())};
  parallel_for(static_cast<std::size_t>(plane.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    float* target = &sum.values[at(sum, 0, y)];
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const int source_y = std::clamp(y + static_cast<int>(k) - radius, 0, plane.height - 1);
      const float* source = &plane.values[at(plane, 0, source_y)];
      const float weight = kernel[k];
      for (int x = 0; x < plane.width; ++x) target[x] += weight * source[x];
    }
  });
  return sum;
}

}  // namespace

Plane convolve(const Plane& plane, const Kernel& along_rows, const Kernel& along_columns) {
  return convolve_columns(convolve_rows(plane, along_rows), along_columns);
}

}  // namespace lemma
