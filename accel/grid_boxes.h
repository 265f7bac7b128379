#pragma once

#include "accel/grid_cells.h"

namespace lemma {

/// How far hits and walks may err (build_grid_cells).
struct GridMargins {
  double cell;   // the walk, in cells
  double reach;  // a hit off its triangle [scene units]
};

/// Fits the boxes of the grid's records around the parts of the triangles in their cells, on several threads.
/// A ray that hits a triangle where it passes the cell, margins included, passes the box, as float32 slabs
/// compute it (BoxTest in grid_boxes-inl.h).
/// Sorts lists of several parts so that those are compact, and fits their boxes as well.
void fit_boxes(std::span<const Triangle> triangles, const GridMargins& margins, GridCells& grid);

}  // namespace lemma
