#pragma once

#include <bit>
#include <limits>

#include "accel/grid_cells.h"
#include "src/core/ray.h"

/// The walk becomes part of the function that calls it and so is compiled for that one's instruction set:
/// calls between code for AVX and code for less would cost more than the walk.
#define LEMMA_INLINE [[gnu::always_inline]] inline

namespace lemma {

/// A ray made ready for walks through grids.
struct WalkedRay {
  LEMMA_INLINE explicit WalkedRay(const Ray& ray)
      : origin(ray.origin), direction(ray.direction), t_min(ray.t_min) {
    for (int k = 0; k < 3; ++k) reciprocal[k] = 1 / direction[k];
  }
  Vec3d origin, direction, reciprocal;
  double t_min;
};

/// The occupied cells that a ray passes, in order: a 3D DDA within bricks that hold any, leaps over those
/// that do not. Source: Amanatides, Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987.
/// In double, and with crossings computed anew from indices at every brick: sums of steps would drift by 1e-2
/// of a cell over 1000 cells in float32. Where a ray passes a cell's edge or corner either neighbour may come
/// first; GridCells::margin covers both.
class GridWalk {
 public:
  /// Stands at the first occupied cell, or is done.
  /// @param limit  no cell that the ray enters at t >= limit is of interest
  LEMMA_INLINE GridWalk(const GridCells& grid, const WalkedRay& ray, double limit) : grid_(grid) {
    double enter = ray.t_min, leave = limit;
    for (int k = 0; k < 3; ++k) clip(k, ray, enter, leave);
    done_ = !(enter <= leave) || grid.bricks.empty();
    if (done_) return;
    for (int k = 0; k < 3; ++k) start(k, ray, enter);
    enter_brick();
    find_occupied(limit);
  }

  [[nodiscard]] bool done() const { return done_; }

  /// Number of the current cell's list.
  [[nodiscard]] LEMMA_INLINE std::size_t list() const {
    return brick_->first_list + static_cast<std::size_t>(std::popcount(brick_->occupied & (bit() - 1)));
  }

  /// t at which the ray leaves the current cell.
  [[nodiscard]] LEMMA_INLINE double cell_exit() const { return crossing_[exit_axis()]; }

  /// Place of the current cell.
  [[nodiscard]] const std::array<int, 3>& position() const { return position_; }

  /// Goes to the next occupied cell that the ray enters at t < limit, or is done.
  LEMMA_INLINE void step(double limit) {
    step_cell(limit);
    find_occupied(limit);
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// Shortens [enter, leave] to the part between the two planes of axis k. A ray parallel to them is either
  /// between them or nowhere; comparisons with NaN leave an empty interval.
  LEMMA_INLINE void clip(int k, const WalkedRay& ray, double& enter, double& leave) const {
    if (ray.direction[k] == 0) {
      if (!(grid_.lo[k] <= ray.origin[k] && ray.origin[k] <= grid_.hi[k])) leave = -kNever;
      return;
    }
    const double a = (grid_.lo[k] - ray.origin[k]) * ray.reciprocal[k];
    const double b = (grid_.hi[k] - ray.origin[k]) * ray.reciprocal[k];
    const double near = ray.direction[k] > 0 ? a : b, far = ray.direction[k] > 0 ? b : a;
    if (!(near <= far)) leave = -kNever;  // not a number
    enter = std::max(enter, near);
    leave = std::min(leave, far);
  }

  LEMMA_INLINE void start(int k, const WalkedRay& ray, double enter) {
    const auto axis = static_cast<std::size_t>(k);
    const double direction = ray.direction[k];
    from_[axis] = (ray.origin[k] - grid_.lo[k]) * grid_.cells_per_unit[k];
    speed_[axis] = direction * grid_.cells_per_unit[k];
    forward_[axis] = direction > 0 ? 1 : 0;
    moves_[axis] = direction > 0 ? 1 : direction < 0 ? -1 : 0;
    end_[axis] = direction > 0 ? grid_.counts[axis] : -1;
    cell_time_[axis] = direction != 0 ? grid_.cell_size[k] * ray.reciprocal[k] : 0;
    first_time_[axis] = direction != 0 ? (grid_.lo[k] - ray.origin[k]) * ray.reciprocal[k] : kNever;
    const double position = from_[axis] + enter * speed_[axis];
    position_[axis] = static_cast<int>(std::clamp(position, 0.0, grid_.counts[axis] - 1.0));
  }

  /// t at which the ray meets the plane between cells i - 1 and i of axis k.
  [[nodiscard]] LEMMA_INLINE double plane_time(std::size_t k, int i) const {
    return first_time_[k] + i * cell_time_[k];
  }

  [[nodiscard]] LEMMA_INLINE std::uint64_t bit() const {
    return std::uint64_t{1} << ((position_[0] & 3) | (position_[1] & 3) << 2 | (position_[2] & 3) << 4);
  }

  [[nodiscard]] LEMMA_INLINE std::size_t exit_axis() const {
    const std::size_t k = crossing_[1] < crossing_[0] ? 1 : 0;
    return crossing_[2] < crossing_[k] ? 2 : k;
  }

  LEMMA_INLINE void enter_brick() {
    brick_ = &grid_.bricks[grid_.brick_index(position_[0] >> 2, position_[1] >> 2, position_[2] >> 2)];
    if (brick_->occupied == 0) return;
    for (std::size_t k = 0; k < 3; ++k) crossing_[k] = plane_time(k, position_[k] + forward_[k]);
  }

  LEMMA_INLINE void find_occupied(double limit) {
    while (!done_) {
      if (brick_->occupied == 0) {
        leap(limit);
      } else if ((brick_->occupied & bit()) == 0) {
        step_cell(limit);
      } else {
        return;
      }
    }
  }

  /// To the next cell, by the face through which the ray leaves this one.
  LEMMA_INLINE void step_cell(double limit) {
    const std::size_t k = exit_axis();
    if (!(crossing_[k] < limit)) {
      done_ = true;
      return;
    }
    const int old = position_[k];
    position_[k] += moves_[k];
    if (position_[k] == end_[k]) {
      done_ = true;
    } else if ((position_[k] ^ old) < GridCells::kBrick) {
      crossing_[k] += std::abs(cell_time_[k]);  // at most three sums before the next brick
    } else {
      enter_brick();
    }
  }

  /// Out of the cube of empty bricks around this one.
  LEMMA_INLINE void leap(double limit) {
    const int reach = static_cast<int>(brick_->clearance);
    std::array<int, 3> plane;
    std::array<double, 3> time;
    for (std::size_t k = 0; k < 3; ++k) {
      const int brick = position_[k] >> 2;
      plane[k] = GridCells::kBrick * (forward_[k] != 0 ? brick + reach : brick - reach + 1);
      time[k] = plane_time(k, plane[k]);
    }
    std::size_t exit = time[1] < time[0] ? 1 : 0;
    if (time[2] < time[exit]) exit = 2;
    const double t = time[exit];
    if (!(t < limit)) {
      done_ = true;
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const int cell = static_cast<int>(from_[k] + t * speed_[k]);
      // Rounding must not send the walk back, or it might go in circles.
      position_[k] = forward_[k] != 0 ? std::min(std::max(cell, position_[k]), grid_.counts[k] - 1)
                                      : std::max(std::min(cell, position_[k]), 0);
    }
    position_[exit] = forward_[exit] != 0 ? plane[exit] : plane[exit] - 1;
    if (position_[exit] < 0 || position_[exit] >= grid_.counts[exit]) {
      done_ = true;
      return;
    }
    enter_brick();
  }

  const GridCells& grid_;
  const Brick* brick_ = nullptr;
  bool done_;
  std::array<int, 3> position_{}, moves_{}, forward_{}, end_{};
  std::array<double, 3> from_{}, speed_{};            // place of the ray in cells: from + t speed
  std::array<double, 3> cell_time_{}, first_time_{};  // t of plane i: first_time + i cell_time
  std::array<double, 3> crossing_{};  // t at which the ray leaves the current cell by each axis
};

}  // namespace lemma
