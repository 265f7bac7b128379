#pragma once

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
    for (int k = 0; k < 3; ++k) {
      reciprocal[k] = 1 / direction[k];
      octant |= direction[k] < 0 ? 0u : 1u << k;
    }
  }
  Vec3d origin, direction, reciprocal;
  double t_min;
  unsigned octant = 0;  // bit k: does not go down axis k
};

/// The occupied cells that a ray passes, in order: a 3D DDA that leaps over empty space. Source: Amanatides,
/// Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987.
///
/// The ray is clipped to the box in double; from there on all is float32, three axes in the lanes of a
/// vector. Places in the grid err by less than 4 roundings of the number of cells an axis, 2^-10 of a cell
/// with kMaxCellsPerAxis: planes are compared with where the ray entered before anything is scaled, so a ray
/// that is all but parallel to a plane keeps that bound; sums of steps would not. Where a ray passes a cell's
/// edge or corner either neighbour may come first. GridCells::margin covers both.
class GridWalk {
 public:
  /// Stands at the first occupied cell, or is done.
  /// @param limit  no cell that the ray enters at t >= limit is of interest
  LEMMA_INLINE GridWalk(const GridCells& grid, const WalkedRay& ray, float limit)
      : counts_{grid.counts[0], grid.counts[1], grid.counts[2], 1},
        row_(static_cast<std::size_t>(grid.counts[0])),
        slice_(row_ * static_cast<std::size_t>(grid.counts[1])),
        clearance_(grid.clearances(ray.octant)) {
    double enter = ray.t_min, leave = limit;
    for (int k = 0; k < 3; ++k) {
      const double a = (grid.lo[k] - ray.origin[k]) * ray.reciprocal[k];
      const double b = (grid.hi[k] - ray.origin[k]) * ray.reciprocal[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    done_ = !(enter <= leave) || clearance_ == nullptr;
    if (done_) return;
    enter_ = enter;
    for (int k = 0; k < 3; ++k) start(k, grid, ray);
    place();
    find_occupied(limit);
  }

  [[nodiscard]] LEMMA_INLINE bool done() const { return done_; }

  /// Index of the current cell.
  [[nodiscard]] LEMMA_INLINE std::size_t cell() const { return cell_; }

  /// Goes to the next occupied cell that the ray enters at t < limit, or is done.
  LEMMA_INLINE void step(float limit) {
    leap(1, limit);
    find_occupied(limit);
  }

 private:
  // Three axes; the fourth lane is one of a grid of one cell that the ray never leaves.
  using Ints [[gnu::vector_size(16)]] = int;
  using Floats [[gnu::vector_size(16)]] = float;

  LEMMA_INLINE void start(int k, const GridCells& grid, const WalkedRay& ray) {
    const double entry = ray.origin[k] + enter_ * ray.direction[k];
    const auto from = static_cast<float>((entry - grid.lo[k]) * grid.cells_per_unit[k]);
    const auto last = static_cast<float>(counts_[k] - 1);
    // The order of arguments makes 0 of what is not a number.
    position_[k] = static_cast<int>(std::min(std::max(0.0f, from), last));
    const bool parallel = ray.direction[k] == 0;
    from_[k] = parallel ? static_cast<float>(position_[k]) + 0.5f : from;
    speed_[k] = static_cast<float>(ray.direction[k] * grid.cells_per_unit[k]);
    cell_time_[k] = parallel ? kNever : static_cast<float>(grid.cell_size[k] * ray.reciprocal[k]);
    backward_[k] = ray.direction[k] < 0 ? -1 : 0;
  }

  LEMMA_INLINE void place() {
    cell_ = static_cast<std::size_t>(position_[0]) + static_cast<std::size_t>(position_[1]) * row_ +
            static_cast<std::size_t>(position_[2]) * slice_;
  }

  LEMMA_INLINE void find_occupied(float limit) {
    while (!done_) {
      const int clearance = clearance_[cell_];
      if (clearance == 0) return;
      leap(clearance, limit);
    }
  }

  /// Out of the cube of `size` cells an axis, of which the current cell is the corner where the ray comes
  /// from.
  LEMMA_INLINE void leap(int size, float limit) {
    const Ints plane = position_ + (backward_ ? 1 - Ints{} - size : Ints{} + size);
    const Floats time = (__builtin_convertvector(plane, Floats) - from_) * cell_time_;
    const float t = std::min(std::min(time[0], time[1]), time[2]);
    const Ints exits = time <= t;
    const Ints reached = __builtin_convertvector(from_ + t * speed_, Ints);
    // Rounding must not send the walk back, or it might go in circles, nor out of the grid.
    const Ints ahead = backward_ ? smaller(reached, position_) : larger(reached, position_);
    const Ints inside = smaller(larger(ahead, Ints{}), counts_ - 1);
    position_ = exits ? plane + backward_ : inside;
    const Ints outside = (position_ < 0) | (position_ >= counts_);
    done_ = !(t < limit - enter_) || (outside[0] | outside[1] | outside[2]) != 0;
    if (!done_) place();
  }

  LEMMA_INLINE static Ints smaller(Ints a, Ints b) { return a < b ? a : b; }
  LEMMA_INLINE static Ints larger(Ints a, Ints b) { return a > b ? a : b; }

  static constexpr float kNever = std::numeric_limits<float>::max();

  Ints position_{}, counts_, backward_{};
  Floats from_{}, speed_{};                           // place of the ray in cells: from + (t - enter) speed
  Floats cell_time_{kNever, kNever, kNever, kNever};  // t that the ray takes for a cell
  double enter_ = 0;                                  // t at which the ray enters the grid
  std::size_t row_, slice_, cell_ = 0;
  const std::uint8_t* clearance_;
  bool done_;
};

}  // namespace lemma
