#pragma once

#include <limits>

#include "accel/grid_cells.h"
#include "src/core/ray.h"

namespace lemma {

/// The cells that a ray passes, in order: a 3D DDA.
/// Source: Amanatides, Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987. In double,
/// and with every crossing computed anew from the cell's index: sums of steps would drift by 1e-2 of a cell
/// over 1000 cells in float32. Where a ray passes a cell's edge or corner either neighbour may come first;
/// GridCells::kCellMargin covers both.
class GridWalk {
 public:
  GridWalk(const GridCells& grid, const Ray& ray) : grid_(grid) {
    double enter = ray.t_min, leave = ray.t_max;
    for (int k = 0; k < 3; ++k) clip(k, ray.origin[k], ray.direction[k], enter, leave);
    done_ = !(enter <= leave) || grid.references.empty();
    if (done_) return;
    for (int k = 0; k < 3; ++k) start(k, ray.origin[k], ray.direction[k], enter);
    cell_ = grid.index(position_);
    find_exit();
  }

  [[nodiscard]] bool done() const { return done_; }
  [[nodiscard]] std::size_t cell() const { return cell_; }

  /// t at which the ray leaves the current cell.
  [[nodiscard]] double cell_exit() const { return crossing_[exit_axis_]; }

  void step() {
    const std::size_t k = exit_axis_;
    position_[k] += direction_[k];
    if (position_[k] < 0 || position_[k] >= grid_.counts[k]) {
      done_ = true;
      return;
    }
    cell_ = grid_.index(position_);
    crossing_[k] = next_crossing(k);
    find_exit();
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// Shortens [enter, leave] to the part between the two planes of axis k. A ray parallel to them is either
  /// between them or nowhere; comparisons with NaN leave an empty interval.
  void clip(int k, double origin, double direction, double& enter, double& leave) const {
    if (direction == 0) {
      if (!(grid_.lo[k] <= origin && origin <= grid_.hi[k])) leave = -kNever;
      return;
    }
    const double a = (grid_.lo[k] - origin) / direction, b = (grid_.hi[k] - origin) / direction;
    const double near = direction > 0 ? a : b, far = direction > 0 ? b : a;
    if (!(near <= far)) leave = -kNever;  // not a number
    enter = std::max(enter, near);
    leave = std::min(leave, far);
  }

  void start(int k, double origin, double direction, double enter) {
    const auto axis = static_cast<std::size_t>(k);
    const double position = (origin + enter * direction - grid_.lo[k]) * grid_.cells_per_unit[k];
    position_[axis] = static_cast<int>(std::clamp(std::floor(position), 0.0, grid_.counts[axis] - 1.0));
    direction_[axis] = direction > 0 ? 1 : direction < 0 ? -1 : 0;
    if (direction != 0) {
      cell_time_[axis] = grid_.cell_size[k] / direction;
      first_crossing_[axis] = (grid_.lo[k] - origin) / direction;
      if (direction > 0) first_crossing_[axis] += cell_time_[axis];
    }
    crossing_[axis] = next_crossing(axis);
  }

  /// t at which the ray crosses the face of the current cell that it leaves by on axis k.
  [[nodiscard]] double next_crossing(std::size_t k) const {
    return direction_[k] == 0 ? kNever : first_crossing_[k] + position_[k] * cell_time_[k];
  }

  void find_exit() {
    exit_axis_ = crossing_[0] < crossing_[1] ? 0 : 1;
    if (crossing_[2] < crossing_[exit_axis_]) exit_axis_ = 2;
  }

  const GridCells& grid_;
  bool done_;
  std::array<int, 3> position_{}, direction_{};
  std::array<double, 3> cell_time_{}, first_crossing_{}, crossing_{};
  std::size_t cell_ = 0, exit_axis_ = 0;
};

}  // namespace lemma
