#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "accel/grid_cells.h"
#include "src/core/ray.h"

/// The walk becomes part of the function that calls it and so is compiled for that one's instruction set:
/// calls between code for AVX and code for less would cost more than the walk.
#define LEMMA_INLINE [[gnu::always_inline]] inline

namespace lemma {

/// How a ray crosses a grid: along the axis on which it passes most cells it goes from slice to slice, one
/// cell thick, and in each moves by at most one cell on the other two. Lengths are in cells, `s` along the
/// first axis from where the walk begins: the ray's origin if that is in the grid, else where it enters.
/// Where the ray leaves by a side shows when it is walked (Slices::leaves).
///
/// Up to where the walk begins all is double; from there on float32. Places in the grid, and the s of a plane
/// times a slope, err by less than 4 roundings of the number of cells an axis, 2^-10 of a cell with
/// kMaxCellsPerAxis: one each for the start, the slope times s of up to that number, s itself and the sum.
struct GridCrossing {
  static constexpr double kError = 0x1p-10;  // [cells]

  /// @param limit  nothing at t > limit is of interest
  LEMMA_INLINE GridCrossing(const GridLevel& level, const Ray& ray, float limit) {
    std::array<double, 3> start, speed;
    bool inside = ray.t_min >= 0;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      speed[axis] = ray.direction[k] * level.cells_per_unit[k];
      start[axis] = (ray.origin[k] - level.lo[k]) * level.cells_per_unit[k];
      inside &= (start[axis] >= 0) & (start[axis] <= level.counts[axis]);
    }
    const double x = std::abs(speed[0]), y = std::abs(speed[1]), z = std::abs(speed[2]);
    const std::size_t main = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    static constexpr std::array<std::size_t, 4> kNext{1, 2, 0, 1};
    const std::size_t u = kNext[main], v = kNext[main + 1];
    slices_per_t = std::abs(speed[main]);
    const double slices_pace = 1 / slices_per_t;
    Place place{start[main], start[u], start[v]};
    const Place slope{speed[main] > 0 ? 1.0 : -1.0, speed[u] * slices_pace, speed[v] * slices_pace};
    const int count = level.counts[main];
    if (!inside) {
      before = ray.t_min * slices_per_t;
      if (!enters({count, level.counts[u], level.counts[v]}, slope, place)) return;
    }
    const std::array<int, 3> strides{1, level.counts[0], level.counts[0] * level.counts[1]};
    const int down = speed[main] > 0 ? 0 : 1, first = std::min(static_cast<int>(place.main), count - 1);
    step = (1 - 2 * down) * strides[main];
    slice = first * strides[main];
    to_plane = static_cast<float>(std::abs(first + 1 - down - place.main));
    slices_ahead = down != 0 ? first + 1 : count - first;
    slices = slices_until(limit);
    side[0] = {static_cast<float>(place.u - 0.5), static_cast<float>(slope.u), strides[u],
               level.counts[u] - 1, 1 << u};
    side[1] = {static_cast<float>(place.v - 0.5), static_cast<float>(slope.v), strides[v],
               level.counts[v] - 1, 1 << v};
  }

  /// How many slices the ray enters up to t = limit: s of the last is to_plane - 1 and one more for each
  /// before. No more than are ahead: at once for rays without an end, whose walk need not wait for the sum.
  [[nodiscard]] LEMMA_INLINE int slices_until(double limit) const {
    if (limit == std::numeric_limits<double>::infinity()) return slices_ahead;
    const double end = limit * slices_per_t - before + (2 + kError) - to_plane;
    return std::min(slices_ahead, static_cast<int>(within(end, 2 * GridLevel::kMaxCellsPerAxis)));
  }

  /// One of the other two axes.
  struct Side {
    float start, slope;  // place where the walk begins, from the first cell's centre; cells a slice
    int stride, last;    // of the index of a cell; the last cell
    int neighbour;       // place of the next cell in a group of neighbours (GridCells::near)
  };
  std::array<Side, 2> side;
  int slice, step;       // of the indices of the first slice's cells; to those of the next
  int slices_ahead = 0;  // of the grid, in the ray's direction from the first on
  int slices = 0;        // to walk through; the ray may leave the grid before
  float to_plane;        // s at which the ray leaves the first slice
  double slices_per_t;
  double before = 0;  // slices from the ray's origin to where the walk begins

 private:
  template <class T>
  struct Axes {
    T main, u, v;  // the walk's axis and the other two
  };
  using Place = Axes<double>;

  /// Moves the place to where the ray enters the grid, from `before` slices after the origin on; says whether
  /// it does. Divides only where the ray comes in by a side: what follows waits for the place.
  LEMMA_INLINE bool enters(const Axes<int>& size, const Place& slope, Place& place) {
    const double gap = slope.main > 0 ? -place.main : place.main - size.main;
    if (gap > before) before = gap;
    const auto pass_side = [&](double origin, double slope, int size) {
      const double here = origin + slope * before;
      if (here < 0 && slope > 0) before -= here / slope;
      if (here > size && slope < 0) before -= (here - size) / slope;
    };
    pass_side(place.u, slope.u, size.u);
    pass_side(place.v, slope.v, size.v);
    place.main = before == gap ? (slope.main > 0 ? 0 : size.main) : place.main + slope.main * before;
    place.u += slope.u * before;
    place.v += slope.v * before;
    const auto between = [](double x, int size) { return (x > -kError) & (x < size + kError); };
    if (!(between(place.main, size.main) & between(place.u, size.u) & between(place.v, size.v))) return false;
    place.main = within(place.main, size.main);
    return true;
  }

  /// x clamped to [0, most]; 0 where it is not a number, as of rays that are not finite.
  [[nodiscard]] LEMMA_INLINE static double within(double x, double most) {
    return std::min(x > 0 ? x : 0, most);
  }
};

}  // namespace lemma
