#pragma once

#include "accel/grid_cells.h"
#include "accel/watertight.h"

namespace lemma {

/// The queries of the grid, compiled for one instruction set.
struct GridTrace {
  /// Replaces `best`, no_hit() at first, by the closest hit if there is one.
  void (*closest)(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best);
  bool (*any)(const GridCells& grid, const Ray& ray, const ShearedRay& sheared);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the same answers, bit for bit.
[[nodiscard]] const std::vector<GridTrace>& grid_traces();

}  // namespace lemma
