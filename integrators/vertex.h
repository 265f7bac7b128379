#pragma once

#include <type_traits>

#include "integrators/surface_point.h"
#include "src/core/frame.h"
#include "src/core/hit.h"
#include "src/core/sampler.h"
#include "src/scene/scene.h"

namespace lemma {

/// A direction drawn at a vertex.
struct ScatterSample {
  Vec3 origin;        // of a ray that leaves in this direction
  Vec3 wi;            // unit, world space
  PdfSolidAngle pdf;  // infinite at glass: no light sample finds the direction
  Rgb weight;         // f cos(theta_i) / pdf
};

/// How much light a vertex scatters from a direction.
struct ScatterValue {
  Rgb f_cos;          // f(wo, wi) cos(theta_i)
  PdfSolidAngle pdf;  // with which sample() returns wi
};

/// A point of a path where light is scattered: the surface as seen along a ray. Both normals are turned to
/// the side the ray comes from; directions must lie above the horizons of both, else the BRDF is 0.
template <Model M>
class Vertex {
 public:
  Vertex(const Scene& scene, const Ray& ray, const Hit& hit)
      : scene_(scene), hit_(hit), material_(find_material(scene, hit)), brdf_(material_) {
    const SurfacePoint point(scene.triangles[hit.triangle], hit.b1, hit.b2, ray.direction);
    behind_ = point.behind;
    origin_ = point.origin;
    geometric_normal_ = Vec3(point.normal);
    frame_ = frame_around(find_shading_normal(scene, ray, hit));
    wo_ = frame_.to_local(-ray.direction);
  }
  Vertex(const Vertex&) = delete;
  Vertex& operator=(const Vertex&) = delete;

  /// Where rays that leave start, off the surface by its error bound; also the point from which lights are
  /// looked at.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// Unit; light arriving from below it is not reflected.
  [[nodiscard]] const Vec3& shading_normal() const { return frame_.n; }

  /// What it reflects, in outline.
  [[nodiscard]] Reflection reflection() const {
    if constexpr (!M.specular) return {};
    return outline(material_, frame_.to_world({-wo_.x, -wo_.y, wo_.z}));
  }

  /// Whether light goes on in single directions only, which no light sample finds.
  [[nodiscard]] bool is_glass() const {
    if constexpr (M.glass) return lemma::is_glass(scene_, hit_.triangle);
    return false;
  }

  /// Of a unit direction in world space; 0 at glass, where it is a Dirac function.
  [[nodiscard]] ScatterValue at(const Vec3& wi) const {
    if (is_glass() || !above_surface(wi)) return {};
    const Vec3 local = frame_.to_local(wi);
    const auto [f, pdf] = brdf_.at(wo_, local);
    return {f * std::max(local.z, 0.0f), pdf};
  }

  /// Draws a direction by the BRDF; nothing if it absorbs.
  [[nodiscard]] std::optional<ScatterSample> sample(Sampler& random) const {
    if (is_glass()) return sample_glass(random.next());
    const std::optional<BrdfSample> local = sample_brdf(random);
    if (!local) return std::nullopt;
    const Vec3 wi = frame_.to_world(local->wi);
    if (!above_surface(wi)) return std::nullopt;
    return ScatterSample{origin_, wi, local->pdf, local->weight};
  }

 private:
  using OwnMaterial = std::conditional_t<M.textures, Material, const Material&>;

  static OwnMaterial find_material(const Scene& scene, const Hit& hit) {
    if constexpr (M.textures) {
      return textured_material(scene, hit);
    } else {
      return scene.materials[material_index(scene, hit)];
    }
  }

  [[nodiscard]] std::optional<BrdfSample> sample_brdf(Sampler& random) const {
    if constexpr (M.specular) return brdf_.sample(wo_, random.next_choice_pair());
    return brdf_.sample(wo_, 0, random.next_2d());
  }

  /// With flat normals the two horizons are one, and the BRDF knows it.
  [[nodiscard]] bool above_surface(const Vec3& wi) const {
    if constexpr (M.smooth_normals) return dot(wi, geometric_normal_) > 0;
    return true;
  }

  [[nodiscard]] Vec3 find_shading_normal(const Scene& scene, const Ray& ray, const Hit& hit) const {
    if constexpr (!M.smooth_normals) return geometric_normal_;
    const auto& [n0, n1, n2] = scene.normals[hit.triangle];
    return smooth_normal({n0, n1, n2}, hit.b1, hit.b2, ray.direction, geometric_normal_);
  }

  /// A mirrored or refracted direction about the shading normal; about the geometric one where the shading
  /// normal would send the light to the other side of the surface than it says.
  [[nodiscard]] ScatterSample sample_glass(float choice) const {
    const Frame geometric = frame_around(geometric_normal_);
    const DielectricSample smooth = glass_about(frame_, choice);
    const bool passes = dot(frame_.to_world(smooth.wi), geometric_normal_) < 0;
    const bool agree = passes == smooth.refracted;
    const DielectricSample sample = agree ? smooth : glass_about(geometric, choice);
    const Vec3 wi = (agree ? frame_ : geometric).to_world(sample.wi);
    constexpr PdfSolidAngle single_direction{std::numeric_limits<float>::infinity()};
    return {sample.refracted ? origin_behind() : origin_, wi, single_direction, sample.weight};
  }

  [[nodiscard]] DielectricSample glass_about(const Frame& frame, float choice) const {
    Dielectric boundary = scene_.glass[material_index(scene_, hit_)];
    if (behind_) boundary.ior = 1 / boundary.ior;  // the frame stands on the ray's side
    return sample_dielectric(boundary, frame.to_local(frame_.to_world(wo_)), choice);
  }

  [[nodiscard]] Vec3 origin_behind() const {
    const Triangle& triangle = scene_.triangles[hit_.triangle];
    const Vec3d normal = normalize(area_vector(triangle)) * (behind_ ? 1.0 : -1.0);
    return offset_origin(point_at(triangle, hit_.b1, hit_.b2), normal, triangle);
  }

  const Scene& scene_;
  const Hit& hit_;
  OwnMaterial material_;
  Phong<M.specular> brdf_;
  Vec3 origin_, geometric_normal_;
  Frame frame_;
  Vec3 wo_;
  bool behind_ = false;  // the ray comes from the side that the winding's normal does not point to
};

}  // namespace lemma
