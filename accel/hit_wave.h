#pragma once

#include <span>
#include <vector>

#include "src/core/triangle.h"
#include "src/core/wave.h"

namespace lemma {

/// hit_on() (accel/watertight.h) for the first `count` lanes, compiled for one instruction set: t, b1 and b2
/// of rays on the triangles that `hits` names. Of lanes without a triangle, and of those up to
/// wave_end(count), they become any numbers.
struct HitsOnTriangles {
  void (*function)(std::span<const Triangle> triangles, const RayWave& rays, std::size_t count,
                   HitWave& hits);
  const char* name;  // "AVX2"
};

/// The fastest that this machine can run.
[[nodiscard]] HitsOnTriangles hits_on_triangles();

/// Those that this machine can run, the fastest first. All give the same hits, bit for bit.
[[nodiscard]] const std::vector<HitsOnTriangles>& all_hits_on_triangles();

}  // namespace lemma
