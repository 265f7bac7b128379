#pragma once

#include "src/core/triangle.h"
#include "src/scene/read_obj.h"

namespace lemma {

/// Whether a triangle of a file can be used, and else why it is dropped.
enum class Soundness {
  sound,
  not_finite,  // a vertex is NaN, infinite or beyond 1e18
  zero_area    // exactly
};

[[nodiscard]] Triangle shape_of(const ObjFile& obj, const ObjTriangle& triangle);
[[nodiscard]] Soundness soundness_of(const Triangle& shape);

}  // namespace lemma
