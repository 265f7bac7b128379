#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "accel/accelerator.h"
#include "src/core/bounds.h"
#include "src/core/sampler.h"
#include "src/lights/light_sampler.h"
#include "src/scene/camera.h"

namespace lemma {

/// Where the rays of a parity check come from: three kinds that rendering makes, and the ones that bad luck
/// and regular scenes make.
enum class RayKind {
  camera,
  bounce,
  shadow,
  vertex,      // at a vertex
  edge,        // at the middle of an edge
  cell,        // from corners of a grid along its faces, edges and diagonals
  axis,        // parallel to an axis, the other components 0 or -0, often through a vertex
  grazing,     // at a surface, 0.1 to 1e-7 from its plane
  coplanar,    // within the plane of a triangle
  on_surface,  // from a rounded point of a triangle, without offset
  far          // from 1e2 to 1e6 times the size of the scene away
};
inline constexpr std::array<std::string_view, 11> kRayKindNames{
    "camera", "bounce", "shadow", "vertex", "edge", "cell", "axis", "grazing", "coplanar", "surface", "far"};
inline constexpr std::size_t kRayKinds = kRayKindNames.size();

/// Of every 20 rays 4 are of each kind that rendering makes, 1 of each other.
[[nodiscard]] RayKind kind_of(std::uint32_t index);

/// What rays are made of. Camera and lights may be null: then rays come from beside the scene's box, and
/// shadow rays join points of surfaces. Lights are such as draw points.
struct RayScene {
  std::span<const Triangle> triangles;
  const Accelerator* walker = nullptr;  // finds where bounces start; any will do
  const Camera* camera = nullptr;
  const LightSampler* lights = nullptr;
};

/// Draws rays: the same for the same (scene, seed, index), whatever was drawn before.
class RaySource {
 public:
  RaySource(const RayScene& scene, std::uint64_t seed);

  /// A ray of the kind kind_of(index).
  [[nodiscard]] Ray draw(std::uint32_t index) const;

 private:
  /// A point of a triangle.
  struct Place {
    std::uint32_t triangle = 0;
    double b1 = 0, b2 = 0;
  };
  [[nodiscard]] Place any_place(Sampler& random) const;
  [[nodiscard]] Place place_on_path(Sampler& random) const;
  [[nodiscard]] Vec3d point(const Place& place) const;
  [[nodiscard]] Vec3 any_origin(Sampler& random) const;
  [[nodiscard]] Ray leave(const Place& place, Sampler& random) const;

  [[nodiscard]] Ray camera_ray(Sampler& random) const;
  [[nodiscard]] Ray shadow_ray(Sampler& random) const;
  [[nodiscard]] Ray vertex_ray(Sampler& random) const;
  [[nodiscard]] Ray edge_ray(Sampler& random) const;
  [[nodiscard]] Ray cell_ray(Sampler& random) const;
  [[nodiscard]] Ray axis_ray(Sampler& random) const;
  [[nodiscard]] Ray grazing_ray(Sampler& random) const;
  [[nodiscard]] Ray coplanar_ray(Sampler& random) const;
  [[nodiscard]] Ray surface_ray(Sampler& random) const;
  [[nodiscard]] Ray far_ray(Sampler& random) const;

  RayScene scene_;
  std::uint64_t seed_;
  Bounds box_;
  Vec3 size_;     // of the box; at least a little on each axis
  float extent_;  // the largest of it
};

}  // namespace lemma
