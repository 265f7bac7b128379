#pragma once

#include <span>

#include "src/oracle/passage.h"

namespace lemma {

/// Where a ray passes an edge or a vertex within rounding, no single triangle there must be hit, but a leak
/// between them is wrong all the same. A sound test moves vertices by a rounding error, the same for all
/// triangles of a vertex. Join the triangles across the edges in doubt, and drop edges that occur twice: the
/// rest is a closed curve around the cluster. Points it winds around an odd number of times are covered by an
/// odd number of the triangles; and no rounding changes this while the curve stays clear of the ray. So one
/// of them must be hit. A silhouette, where two triangles overlap or neither is met, has the parity 0.
/// @param near  how the ray passes all triangles around it
/// @return the smallest t by which a cluster must have been hit; infinity if none must
[[nodiscard]] double covered_by(const LongRay& ray, std::span<const Triangle> triangles,
                                std::span<const Passage> near);

}  // namespace lemma
