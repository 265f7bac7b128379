#include <fmt/format.h>

#include "accel/accelerator.h"
#include "accel/grid_cells.h"
#include "accel/grid_far.h"
#include "accel/grid_trace.h"

namespace lemma {
namespace {

class Grid final : public Accelerator {
 public:
  Grid(std::span<const Triangle> triangles, const GridResolution& resolution)
      : cells_(build_grid_cells(triangles, resolution)),
        trace_(grid_traces().front()),
        triangles_(triangles.size()) {}

  std::optional<Hit> closest_hit(const Ray& ray) const override {
    if (cells_.levels.empty()) return std::nullopt;
    const ShearedRay sheared(ray);
    Hit best = no_hit(sheared);
    if (needs_careful_walk(cells_, ray)) {
      careful_closest_hit(cells_, ray, sheared, best);
    } else {
      trace_.closest(cells_, ray, sheared, best);
    }
    if (best.t < ray.t_max) return best;
    return std::nullopt;
  }

  bool occluded(const Ray& ray) const override {
    if (cells_.levels.empty()) return false;
    if (needs_careful_walk(cells_, ray)) return closest_hit(ray).has_value();
    return trace_.any(cells_, ray, ShearedRay(ray));
  }

  std::size_t memory_bytes() const override { return cells_.memory_bytes(); }

  std::string description() const override {
    if (cells_.levels.empty()) return "grid without cells";
    const auto& counts = cells_.levels[0].counts;
    return fmt::format("grid of {} x {} x {} cells, {} of them grids, {:.1f} references a triangle, {}",
                       counts[0], counts[1], counts[2], cells_.levels.size() - 1,
                       static_cast<double>(cells_.references.size()) / static_cast<double>(triangles_),
                       trace_.name);
  }

 private:
  GridCells cells_;
  GridTrace trace_;
  std::size_t triangles_;
};

}  // namespace

std::unique_ptr<const Accelerator> make_grid(std::span<const Triangle> triangles,
                                             const AcceleratorOptions& options) {
  return std::make_unique<Grid>(triangles, options.grid);
}

}  // namespace lemma
