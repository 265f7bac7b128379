#pragma once

#include "accel/grid_cells.h"

namespace lemma {

/// Notes a level's occupied cells with those before them (GridCells::near, which holds 0 so far).
void mark_near(const GridLevel& level, GridCells& grid);

}  // namespace lemma
