#include "accel/grid_far.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/error_bound.h"

namespace lemma {
namespace {

/// The largest coordinate difference between the ray's origin and a point of the scene.
double largest_distance(const GridCells& grid, const Ray& ray) {
  const Vec3d o(ray.origin);
  return std::max(max_norm(grid.lo - o), max_norm(grid.hi - o));
}

/// Walks over all occupied cells near a ray.
class CarefulWalk {
 public:
  CarefulWalk(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best)
      : grid_(grid), ray_(ray), sheared_(sheared), best_(best) {
    // Twice the error of a hit: the slabs below err by far less than once.
    error_ = 2 * kPlaneError * kRoundoff * largest_distance(grid, ray);
  }

  void visit(const GridLevel& level) {
    std::array<int, 3> cell{};
    for (cell[2] = 0; cell[2] < level.counts[2]; ++cell[2]) {
      for (cell[1] = 0; cell[1] < level.counts[1]; ++cell[1]) {
        for (cell[0] = 0; cell[0] < level.counts[0]; ++cell[0]) {
          const std::uint32_t index = level.index(cell);
          if (grid_.is_occupied(level, index) && passes(level, cell)) visit(grid_.record(level, index));
        }
      }
    }
  }

 private:
  void visit(const GridCells::Record& record) {
    if (record.count == GridCells::Record::kLevel) return visit(grid_.levels[record.begin]);
    for (std::uint32_t i = 0; i < record.count; ++i) {
      intersect(sheared_, grid_.triangle(record, i), grid_.references[record.begin + i], best_);
    }
  }

  /// Whether the ray's line passes the cell within the error; yes for what is not a number.
  [[nodiscard]] bool passes(const GridLevel& level, const std::array<int, 3>& cell) const {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const double lo = level.lo[k] + cell[axis] / level.cells_per_unit[k] - error_;
      const double hi = level.lo[k] + (cell[axis] + 1) / level.cells_per_unit[k] + error_;
      const double a = (lo - ray_.origin[k]) / ray_.direction[k];
      const double b = (hi - ray_.origin[k]) / ray_.direction[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return !(enter > leave);
  }

  const GridCells& grid_;
  const Ray& ray_;
  const ShearedRay& sheared_;
  Hit& best_;
  double error_;
};

}  // namespace

void careful_closest_hit(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best) {
  CarefulWalk(grid, ray, sheared, best).visit(grid.levels.front());
}

}  // namespace lemma
