#pragma once

#include "accel/grid_cells.h"
#include "accel/watertight.h"

namespace lemma {

/// Whether the ray starts so far from the scene that its hits err by more than the margin of the cells, or
/// its direction is so long or short that the t of boxes err by more than a few roundings: between the bounds
/// neither 1 / d nor what is multiplied by it gets out of float's range before a hit's t does.
/// @param grid  not empty, here and below
[[nodiscard]] inline bool needs_careful_walk(const GridCells& grid, const Ray& ray) {
  const Vec3 &o = ray.origin, &lo = grid.trusted_lo, &hi = grid.trusted_hi;
  const bool far = (o.x < lo.x) | (o.x > hi.x) | (o.y < lo.y) | (o.y > hi.y) | (o.z < lo.z) | (o.z > hi.z);
  const float speed = max_norm(ray.direction);
  return far | (speed < 0x1p-60f) | (speed > 0x1p60f);
}

/// The closest hit of a ray from any distance: tests the cells that the ray passes within the error of hits
/// at that distance, found one by one. Slow, and rare: from further than a camera stands.
/// @param best  no_hit() at first; replaced if there is a hit
void careful_closest_hit(const GridCells& grid, const Ray& ray, const ShearedRay& sheared, Hit& best);

}  // namespace lemma
