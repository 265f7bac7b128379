#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "src/core/hit.h"
#include "src/core/named.h"
#include "src/core/ray.h"
#include "src/core/triangle.h"
#include "src/core/wave.h"

namespace lemma {

/// How the rays of a wave lie, by which a backend may choose how to trace them.
enum class Coherence {
  none,
  steps  // those of each kWaveStep lanes start at one point, in neighbouring directions
};

/// Finds which triangle a ray hits. Ready once it exists; all queries are const and thread-safe and keep no
/// state. A hit counts if its t lies in the open interval (t_min, t_max). A backend decides only *which*
/// triangle: t and the barycentric coordinates are those of intersect() in accel/watertight.h, the same for
/// all. A ray that is not finite hits nothing.
class Accelerator {
 public:
  Accelerator() = default;
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;
  virtual ~Accelerator() = default;

  /// The hit with the smallest t; among equal t, the lowest triangle index where the backend promises it.
  [[nodiscard]] virtual std::optional<Hit> closest_hit(const Ray& ray) const = 0;

  /// Whether there is any hit at all.
  [[nodiscard]] virtual bool occluded(const Ray& ray) const = 0;

  /// closest_hit for the first `count` lanes. Lanes from the count up to wave_end(count) may become any
  /// numbers, and their triangles kNoTriangle.
  virtual void closest_hits(const RayWave& rays, std::size_t count, Coherence coherence, HitWave& hits) const;

  /// occluded for the first `count` lanes: 1 where there is a hit, else 0; lanes up to wave_end(count) may
  /// become 0.
  virtual void occluded_rays(const RayWave& rays, std::size_t count, Wave<std::uint8_t>& blocked) const;

  /// Memory that the structure holds [bytes].
  [[nodiscard]] virtual std::size_t memory_bytes() const = 0;

  /// One line about the structure built, for logs: "grid 21 x 20 x 50 cells, 1.9 references a triangle".
  [[nodiscard]] virtual std::string description() const = 0;
};

/// Number of cells of the uniform grid.
struct GridResolution {
  enum class Rule {
    density,      // by a model of cost: about 3000 cells, or one for 16 triangles (accel/grid_resolution.cpp)
    twenty_seven  // 27 n cells: three times n^(1/3) an axis for a cube
  };
  Rule rule = Rule::density;
  std::size_t cells = 0;  // > 0: about as many cubic cells, whatever the rule; the report used 100000
};

struct AcceleratorOptions {
  GridResolution grid;
};

using AcceleratorFactory = std::unique_ptr<const Accelerator> (*)(std::span<const Triangle>,
                                                                  const AcceleratorOptions&);

/// All backends by the name users give them.
[[nodiscard]] std::span<const Named<AcceleratorFactory>> accelerators();

}  // namespace lemma
