#pragma once

#include "accel/grid_cells.h"
#include "accel/watertight.h"

namespace lemma {

/// Whether the ray starts so far from the scene that its hits err by more than the margin of the cells.
/// @param grid  not empty, here and below
[[nodiscard]] bool starts_far_away(const GridCells& grid, const Ray& ray);

/// The closest hit of a ray that starts at any distance: tests the cells that the ray passes within the error
/// of hits at that distance, found one by one. Slow, and rare: from further than a camera stands.
/// @param best  no_hit() at first; replaced if there is a hit
void closest_hit_from_afar(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best);

}  // namespace lemma
