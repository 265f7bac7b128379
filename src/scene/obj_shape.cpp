#include "src/scene/obj_shape.h"

#include "src/scene/numbers.h"

namespace lemma {
namespace {

bool in_range(const Vec3& v) {
  return is_finite(v) && max_norm(v) <= kMaxCoordinate;
}

}  // namespace

Triangle shape_of(const ObjFile& obj, const ObjTriangle& t) {
  return {obj.vertices[t.vertex[0]], obj.vertices[t.vertex[1]], obj.vertices[t.vertex[2]]};
}

Soundness soundness_of(const Triangle& shape) {
  if (!in_range(shape.v0) || !in_range(shape.v1) || !in_range(shape.v2)) return Soundness::not_finite;
  return area_vector(shape) == Vec3d(0) ? Soundness::zero_area : Soundness::sound;
}

}  // namespace lemma
