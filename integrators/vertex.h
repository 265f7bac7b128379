#pragma once

#include "src/core/error_bound.h"
#include "src/core/frame.h"
#include "src/core/hit.h"
#include "src/core/sampler.h"
#include "src/scene/scene.h"

namespace lemma {

/// A direction drawn at a vertex.
struct ScatterSample {
  Vec3 wi;  // unit, world space
  PdfSolidAngle pdf;
  Rgb weight;  // f cos(theta_i) / pdf
};

/// A point of a path where light is scattered: the surface as seen along a ray. Both normals are turned to
/// the side the ray comes from; directions must lie above the horizons of both, else the BRDF is 0.
template <Model M>
class Vertex {
 public:
  Vertex(const Scene& scene, const Ray& ray, const Hit& hit) : brdf_(scene.materials[material(scene, hit)]) {
    const Triangle& triangle = scene.triangles[hit.triangle];
    Vec3d normal = normalize(area_vector(triangle));
    if (dot(normal, Vec3d(ray.direction)) > 0) normal = -normal;
    origin_ = offset_origin(point_at(triangle, hit.b1, hit.b2), normal, triangle);
    geometric_normal_ = Vec3(normal);
    frame_ = frame_around(find_shading_normal(scene, ray, hit));
    wo_ = frame_.to_local(-ray.direction);
  }

  /// Where rays that leave start, off the surface by its error bound; also the point from which lights are
  /// looked at.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// Unit; light arriving from below it is not reflected.
  [[nodiscard]] const Vec3& shading_normal() const { return frame_.n; }

  /// f(wo, wi) cos(theta_i) for a unit direction in world space.
  [[nodiscard]] Rgb eval_cos(const Vec3& wi) const {
    if (!above_surface(wi)) return {};
    const Vec3 local = frame_.to_local(wi);
    return brdf_.eval(wo_, local) * std::max(local.z, 0.0f);
  }

  /// Density with which sample() returns wi.
  [[nodiscard]] PdfSolidAngle pdf(const Vec3& wi) const {
    return above_surface(wi) ? brdf_.pdf(wo_, frame_.to_local(wi)) : PdfSolidAngle{0};
  }

  /// Draws a direction by the BRDF; nothing if it absorbs.
  [[nodiscard]] std::optional<ScatterSample> sample(Sampler& random) const {
    const float choice = M.specular ? random.next() : 0;
    const std::optional<BrdfSample> local = brdf_.sample(wo_, choice, random.next_2d());
    if (!local) return std::nullopt;
    const Vec3 wi = frame_.to_world(local->wi);
    if (!above_surface(wi)) return std::nullopt;
    return ScatterSample{wi, local->pdf, local->weight};
  }

 private:
  static std::uint32_t material(const Scene& scene, const Hit& hit) {
    return scene.facets[hit.triangle].material;
  }

  /// With flat normals the two horizons are one, and the BRDF knows it.
  [[nodiscard]] bool above_surface(const Vec3& wi) const {
    if constexpr (M.smooth_normals) return dot(wi, geometric_normal_) > 0;
    return true;
  }

  [[nodiscard]] Vec3 find_shading_normal(const Scene& scene, const Ray& ray, const Hit& hit) const {
    if constexpr (!M.smooth_normals) return geometric_normal_;
    const auto& [n0, n1, n2] = scene.normals[hit.triangle];
    const Vec3 n = n0 * (1 - hit.b1 - hit.b2) + n1 * hit.b1 + n2 * hit.b2;
    const float size = length(n);
    // Opposed normals can cancel; what is left then is rounding.
    if (!(size > 1e-6f)) return geometric_normal_;
    return n * (std::copysign(1.0f, -dot(n, ray.direction)) / size);
  }

  Vec3 origin_, geometric_normal_;
  Frame frame_;
  Vec3 wo_;
  Phong<M.specular> brdf_;
};

}  // namespace lemma
