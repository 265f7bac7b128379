#pragma once

#include <cstddef>
#include <cstdint>

#include "src/core/hit.h"
#include "src/core/ray.h"
#include "src/core/rgb.h"
#include "src/core/vec.h"

namespace lemma {

// Many paths are followed together, one a lane, as structure of arrays. What is found for a whole wave is
// found by plain loops over its lanes, without branches, that call the functions of single paths and are
// compiled for every instruction set: compilers turn them into vector code, and a lane gets the same bits as
// a path by itself.

inline constexpr std::size_t kWaveSize = 256;  // lanes; a wave's data then stay in the second-level cache
inline constexpr std::size_t kWaveStep = 16;   // divides kWaveSize; the lanes of the widest registers

/// Where a loop over `count` lanes ends, so that it has no remainder. Lanes from the count on hold what was
/// left there, or zeros: any numbers, but integers that are valid indices.
[[nodiscard]] constexpr std::size_t wave_end(std::size_t count) {
  return (count + kWaveStep - 1) / kWaveStep * kWaveStep;
}

/// A value of each lane. A plain array: through the references of std::array GCC 12 loses its type in loops,
/// and does not make vector code of them.
template <class T>
struct alignas(64) Wave {
  T values[kWaveSize]{};

  [[nodiscard]] T operator[](std::size_t lane) const { return values[lane]; }
  [[nodiscard]] T& operator[](std::size_t lane) { return values[lane]; }
};

struct VecWave {
  Wave<float> x, y, z;

  [[nodiscard]] Vec3 operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(std::size_t lane, const Vec3& v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

struct RgbWave {
  Wave<float> r, g, b;

  [[nodiscard]] Rgb operator[](std::size_t lane) const { return {r[lane], g[lane], b[lane]}; }
  void set(std::size_t lane, const Rgb& c) { r[lane] = c.r, g[lane] = c.g, b[lane] = c.b; }
};

/// Rays with t_min 0.
struct RayWave {
  VecWave origin, direction;
  Wave<float> t_max;

  [[nodiscard]] Ray operator[](std::size_t lane) const {
    return {origin[lane], direction[lane], 0, t_max[lane]};
  }
  void set(std::size_t lane, const Ray& ray) {
    origin.set(lane, ray.origin), direction.set(lane, ray.direction), t_max[lane] = ray.t_max;
  }
};

/// Their hits; of a lane without one `triangle` is kNoTriangle, and the rest any numbers.
struct HitWave {
  static constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;
  Wave<std::uint32_t> triangle;
  Wave<float> t, b1, b2;

  [[nodiscard]] bool is_hit(std::size_t lane) const { return triangle[lane] != kNoTriangle; }
  [[nodiscard]] Hit operator[](std::size_t lane) const {
    return {t[lane], triangle[lane], b1[lane], b2[lane]};
  }
  void set(std::size_t lane, const Hit& hit) {
    triangle[lane] = hit.triangle, t[lane] = hit.t, b1[lane] = hit.b1, b2[lane] = hit.b2;
  }
};

}  // namespace lemma
