#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "accel/grid_cells.h"
#include "src/core/ray.h"

/// The walk becomes part of the function that calls it and so is compiled for that one's instruction set:
/// calls between code for AVX and code for less would cost more than the walk.
#define LEMMA_INLINE [[gnu::always_inline]] inline

namespace lemma {

/// How a ray crosses a grid: along the axis on which it passes most cells it goes from slice to slice, one
/// cell thick, and in each moves by at most one cell on the other two. Lengths are in cells, `s` along the
/// first axis from where the ray enters the grid.
///
/// The ray is clipped to the box in double; from there on all is float32. Places in the grid, and the s of a
/// plane times a slope, err by less than 4 roundings of the number of cells an axis, 2^-10 of a cell with
/// kMaxCellsPerAxis: one each for the start, the slope times s of up to that number, s itself and the sum.
struct GridCrossing {
  /// @param limit  nothing at t > limit is of interest
  LEMMA_INLINE GridCrossing(const GridLevel& level, const Ray& ray, float limit) {
    std::array<double, 3> start, speed, pace;
    double leave = limit;
    enter = ray.t_min;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      speed[axis] = ray.direction[k] * level.cells_per_unit[k];
      start[axis] = (ray.origin[k] - level.lo[k]) * level.cells_per_unit[k];
      pace[axis] = 1 / speed[axis];
      const double a = -start[axis] * pace[axis], b = (level.counts[axis] - start[axis]) * pace[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    misses = !(enter <= leave);
    if (misses) return;
    const double x = std::abs(speed[0]), y = std::abs(speed[1]), z = std::abs(speed[2]);
    const std::size_t main = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    const std::array<int, 3> strides{1, level.counts[0], level.counts[0] * level.counts[1]};
    const auto entry = [&](std::size_t k) { return within(start[k] + enter * speed[k], level.counts[k]); };
    const double first = entry(main);
    const int count = level.counts[main];
    slice = std::min(static_cast<int>(first), count - 1);
    const bool up = speed[main] > 0;
    step = up ? 1 : -1;
    stride = strides[main];
    to_plane = static_cast<float>(up ? slice + 1 - first : first - slice);
    slices_per_t = std::abs(speed[main]);
    slices = up ? count - slice : slice + 1;
    slices = slices_until(leave);
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t k = (main + 1 + i) % 3;
      side[i] = {static_cast<float>(entry(k)),
                 static_cast<float>(speed[k] * std::abs(pace[main])),
                 static_cast<float>(pace[k] * slices_per_t),
                 strides[k],
                 level.counts[k] - 1,
                 1 << k};
    }
  }

  /// How many slices the ray enters up to t = limit: s of the last is to_plane - 1 and one more for each
  /// before. As many as before where the limit is later.
  [[nodiscard]] LEMMA_INLINE int slices_until(double limit) const {
    const double end = (limit - enter) * slices_per_t + (2 + 0x1p-10) - to_plane;
    return std::min(slices, static_cast<int>(within(end, 2 * GridLevel::kMaxCellsPerAxis)));
  }

  /// x clamped to [0, most]; 0 where it is not a number, as of rays that are not finite.
  [[nodiscard]] LEMMA_INLINE static double within(double x, double most) {
    return std::min(std::max(0.0, x), most);
  }

  /// One of the other two axes.
  struct Side {
    float start, slope, pace;  // place where the ray enters the grid; cells a slice; slices a cell
    int stride, last;          // of the index of a cell; the last cell
    int neighbour;             // place of the next cell in a group of neighbours (GridCells::near)
  };
  std::array<Side, 2> side;
  int slice, step, stride,
      slices;      // the first slice, the way to the next, their cells' indices, their number
  float to_plane;  // s at which the ray leaves the first slice
  double enter, slices_per_t;
  bool misses;
};

}  // namespace lemma
