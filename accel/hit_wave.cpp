#include "accel/hit_wave.h"

#include "accel/watertight.h"
#include "src/core/instruction_sets.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/hit_wave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

/// The triangles of a step's lanes.
struct Corners {
  struct Axes {
    alignas(64) float x[kWaveStep], y[kWaveStep], z[kWaveStep];

    [[nodiscard]] Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const Vec3& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  };
  Axes v0, v1, v2;
};

void gather(std::span<const Triangle> triangles, const std::uint32_t* index, Corners& corners) {
  for (std::size_t i = 0; i < kWaveStep; ++i) {
    const Triangle& t = triangles[index[i] == HitWave::kNoTriangle ? 0 : index[i]];
    corners.v0.set(i, t.v0), corners.v1.set(i, t.v1), corners.v2.set(i, t.v2);
  }
}

/// Without branches: compilers turn the inner loop into vector code of the instruction set.
void find(std::span<const Triangle> triangles, const RayWave& rays, std::size_t count, HitWave& hits) {
  if (triangles.empty()) return;
  Corners corners;
  for (std::size_t begin = 0; begin < count; begin += kWaveStep) {
    gather(triangles, &hits.triangle[begin], corners);
    for (std::size_t i = 0; i < kWaveStep; ++i) {
      const std::size_t lane = begin + i;
      const Triangle triangle{corners.v0[i], corners.v1[i], corners.v2[i]};
      const Hit hit = hit_on(ShearedRay(rays[lane]), triangle, 0);
      hits.t[lane] = hit.t, hits.b1[lane] = hit.b1, hits.b2[lane] = hit.b2;
    }
  }
}

}  // namespace

HitsOnTriangles hits_on() {
  return {find, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(hits_on);

HitsOnTriangles hits_on_triangles() {
  return HWY_DYNAMIC_DISPATCH(hits_on)();
}

const std::vector<HitsOnTriangles>& all_hits_on_triangles() {
  static const std::vector<HitsOnTriangles> all = for_every_instruction_set(hits_on_triangles);
  return all;
}

}  // namespace lemma
#endif
