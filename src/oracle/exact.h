#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "src/core/ray.h"
#include "src/core/triangle.h"

namespace lemma {

/// What the ray hits first in real arithmetic: float32 numbers are rationals, and so is everything that
/// decides.
struct ExactHit {
  std::uint32_t triangle = 0;
  double t = 0;  // the true t, rounded; its relative error is some 2^-50 unless the ray grazes the triangle
};

/// The first of the triangles, edges and vertices included, that the ray meets with t in (t_min, t_max); of
/// several at one t the lowest index. A ray in the plane of a triangle does not meet it.
/// @param ray         finite, its direction is not 0
/// @param candidates  indices of the triangles to look at
[[nodiscard]] std::optional<ExactHit> exact_hit(const Ray& ray, std::span<const Triangle> triangles,
                                                std::span<const std::uint32_t> candidates);

}  // namespace lemma
