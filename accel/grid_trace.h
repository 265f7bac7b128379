#pragma once

#include "accel/grid_cells.h"
#include "accel/watertight.h"

namespace lemma {

/// The queries of the grid, compiled for one instruction set. The first two are for rays that do not start
/// far away (grid_far.h).
struct GridTrace {
  /// Replaces `best`, no_hit() at first, by the closest hit if there is one.
  void (*closest)(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best);
  bool (*any)(const GridCells& grid, const Ray& ray, const ShearedRay& sheared);
  /// Appends the occupied cells of the scene's level that the ray passes, in order.
  void (*walk)(const GridCells& grid, const Ray& ray, std::vector<std::uint32_t>& cells);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the same answers, bit for bit.
[[nodiscard]] const std::vector<GridTrace>& grid_traces();

}  // namespace lemma
