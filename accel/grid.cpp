#include <fmt/format.h>

#include "accel/accelerator.h"
#include "accel/grid_cells.h"
#include "accel/grid_walk.h"
#include "accel/watertight.h"

namespace lemma {
namespace {

class Grid final : public Accelerator {
 public:
  Grid(std::span<const Triangle> triangles, const GridResolution& resolution)
      : triangles_(triangles), cells_(build_grid_cells(triangles, resolution)) {}

  std::optional<Hit> closest_hit(const Ray& ray) const override {
    const ShearedRay sheared(ray);
    Hit best = no_hit(sheared);
    for (GridWalk walk(cells_, ray); !walk.done(); walk.step()) {
      for (const std::uint32_t i : cells_.list(walk.cell())) intersect(sheared, triangles_[i], i, best);
      // A hit may lie beyond this cell: it stands only when no later cell can hold a nearer one.
      if (best.t <= walk.cell_exit()) break;
    }
    if (best.t < ray.t_max) return best;
    return std::nullopt;
  }

  bool occluded(const Ray& ray) const override {
    const ShearedRay sheared(ray);
    Hit best = no_hit(sheared);
    for (GridWalk walk(cells_, ray); !walk.done(); walk.step()) {
      for (const std::uint32_t i : cells_.list(walk.cell())) {
        if (intersect(sheared, triangles_[i], i, best)) return true;
      }
      if (best.t <= walk.cell_exit()) break;
    }
    return false;
  }

  std::size_t memory_bytes() const override {
    return (cells_.first.capacity() + cells_.references.capacity()) * sizeof(std::uint32_t);
  }

  std::string description() const override {
    const auto triangles = static_cast<double>(std::max<std::size_t>(triangles_.size(), 1));
    return fmt::format("grid of {} x {} x {} cells, {:.1f} references a triangle", cells_.counts[0],
                       cells_.counts[1], cells_.counts[2],
                       static_cast<double>(cells_.references.size()) / triangles);
  }

 private:
  std::span<const Triangle> triangles_;
  GridCells cells_;
};

}  // namespace

std::unique_ptr<const Accelerator> make_grid(std::span<const Triangle> triangles,
                                             const AcceleratorOptions& options) {
  return std::make_unique<Grid>(triangles, options.grid);
}

}  // namespace lemma
