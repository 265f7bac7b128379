#pragma once

#include "src/core/error_bound.h"
#include "src/core/hit.h"
#include "src/scene/scene.h"

namespace lemma {

/// The point of a triangle that a ray hits, on the side that the ray comes from.
struct SurfacePoint {
  /// @param b1, b2     of the hit
  /// @param direction  of the ray
  SurfacePoint(const Triangle& triangle, float b1, float b2, const Vec3& direction) {
    const Vec3d of_winding = normalize(area_vector(triangle));
    behind = dot(of_winding, Vec3d(direction)) > 0;
    normal = of_winding * (behind ? -1.0 : 1.0);
    origin = offset_origin(point_at(triangle, b1, b2), normal, triangle);
  }

  bool behind;   // the winding's normal points away from that side
  Vec3d normal;  // unit, to that side
  Vec3 origin;   // of rays that leave to that side, off the surface by its error bound
};

/// The normals of a triangle's vertices.
struct VertexNormals {
  Vec3 n0, n1, n2;
};

/// The normal that they give at a hit, unit, on the side the ray comes from; the geometric one where they
/// cancel, as opposed normals can: what is left then is rounding.
[[nodiscard]] inline Vec3 smooth_normal(const VertexNormals& normals, float b1, float b2,
                                        const Vec3& direction, const Vec3& geometric) {
  const Vec3 n = normals.n0 * (1 - b1 - b2) + normals.n1 * b1 + normals.n2 * b2;
  const float size = length(n);
  const Vec3 unit = n * (std::copysign(1.0f, -dot(n, direction)) / size);
  const bool cancel = !(size > 1e-6f);
  return {cancel ? geometric.x : unit.x, cancel ? geometric.y : unit.y, cancel ? geometric.z : unit.z};
}

/// Whether a triangle is a boundary of glass.
[[nodiscard]] inline bool is_glass(const Scene& scene, std::uint32_t triangle) {
  return !scene.glass.empty() && scene.glass[scene.facets[triangle].material].ior != 1;
}

[[nodiscard]] inline std::uint32_t material_index(const Scene& scene, const Hit& hit) {
  return scene.facets[hit.triangle].material;
}

/// The material at a hit, with the colour of its texture if it has one.
[[nodiscard]] inline Material textured_material(const Scene& scene, const Hit& hit) {
  const std::uint32_t index = material_index(scene, hit);
  if (scene.texture_of.empty()) return scene.materials[index];
  const auto& [texture, tint] = scene.texture_of[index];
  if (texture == kNoTexture) return scene.materials[index];
  const auto& [uv0, uv1, uv2] = scene.texcoords[hit.triangle];
  const Vec2 uv = uv0 * (1 - hit.b1 - hit.b2) + uv1 * hit.b1 + uv2 * hit.b2;
  return with_kd(scene.materials[index], tint * scene.textures[texture].at(uv));
}

}  // namespace lemma
