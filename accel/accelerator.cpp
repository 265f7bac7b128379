#include "accel/accelerator.h"

namespace lemma {

void Accelerator::closest_hits(const RayWave& rays, std::size_t count, Coherence, HitWave& hits) const {
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<Hit> hit = closest_hit(rays[i]);
    hits.triangle[i] = HitWave::kNoTriangle;
    if (hit) hits.set(i, *hit);
  }
}

void Accelerator::occluded_rays(const RayWave& rays, std::size_t count, Wave<std::uint8_t>& blocked) const {
  for (std::size_t i = 0; i < count; ++i) blocked[i] = occluded(rays[i]) ? 1 : 0;
}

// The table of backends: a new one is a file that defines make_NAME, and a line here.
#define LEMMA_ACCELERATORS(entry)                             \
  entry(embree, "Embree's bounding volume hierarchy, ROBUST") \
      entry(grid, "3D uniform grid walked by a 3D DDA")       \
          entry(brute, "every triangle for every ray: slow, nothing to go wrong")

#define LEMMA_DECLARE(name, help) \
  std::unique_ptr<const Accelerator> make_##name(std::span<const Triangle>, const AcceleratorOptions&);
LEMMA_ACCELERATORS(LEMMA_DECLARE)

std::span<const Named<AcceleratorFactory>> accelerators() {
#define LEMMA_ENTRY(name, help) {#name, make_##name, help},
  static constexpr Named<AcceleratorFactory> table[] = {LEMMA_ACCELERATORS(LEMMA_ENTRY)};
  return table;
}

}  // namespace lemma
