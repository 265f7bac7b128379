#include <gtest/gtest.h>

#include <cstdio>

#include "accel/accelerator.h"
#include "src/core/error_bound.h"
#include "src/core/frame.h"
#include "src/core/warp.h"
#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

/// A ray that leaves a triangle, as a path does after a hit: every other one within 1e-4 to 1e-2 of the
/// plane.
Ray leaving_ray(const Triangle& t, Sampler& random) {
  const auto [b1, b2] = uniform_triangle(random.next_2d());
  Vec3d normal = normalize(area_vector(t));
  if (random.next() < 0.5f) normal = -normal;
  Vec3 local = cosine_hemisphere(random.next_2d());
  if (random.next() < 0.5f) local.z *= std::pow(10.0f, -2 - 2 * random.next());
  // As Vertex does it: the hit's barycentric coordinates are floats.
  const Vec3d p = point_at(t, static_cast<float>(b1), static_cast<float>(b2));
  return {offset_origin(p, normal, t), normalize(frame_around(Vec3(normal)).to_world(local))};
}

/// Whether `other` lies in the plane of `t`, to the bound of a hit's error.
bool in_plane_of(const Triangle& t, const Triangle& other) {
  const Vec3d normal = normalize(area_vector(t)), v0(t.v0);
  const double size =
      max_norm(Vec3d(t.v1) - v0) + max_norm(Vec3d(t.v2) - v0) + max_norm(Vec3d(other.v0) - v0);
  const double tolerance = kPlaneError * kRoundoff * size;
  return std::abs(dot(normal, Vec3d(other.v0) - v0)) <= tolerance &&
         std::abs(dot(normal, Vec3d(other.v1) - v0)) <= tolerance &&
         std::abs(dot(normal, Vec3d(other.v2) - v0)) <= tolerance;
}

/// How many of the rays that leave the mesh's triangles hit the plane they leave.
int self_hits(const Accelerator& accel, std::span<const Triangle> mesh, std::uint32_t rays) {
  int count = 0;
  for (std::uint32_t i = 0; i < rays; ++i) {
    Sampler random(41, i, 0);
    const Triangle& from = mesh[random.next_bits() % mesh.size()];
    const auto hit = accel.closest_hit(leaving_ray(from, random));
    if (hit && in_plane_of(from, mesh[hit->triangle])) ++count;
  }
  return count;
}

std::vector<Triangle> moved(std::vector<Triangle> mesh, float scale, const Vec3& shift) {
  for (Triangle& t : mesh) {
    for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v * scale + shift;
  }
  return mesh;
}

/// kPlaneError is enough for every backend: no ray finds again the plane that it left, at any scale and
/// place.
TEST(SelfIntersection, NoRayHitsThePlaneItLeaves) {
  constexpr std::uint32_t rays = 50000;
  const std::vector<std::vector<Triangle>> meshes{
      test::own_scene("veach-mis", 8, 8).triangles, test::own_scene("cornell-box", 8, 8).triangles,
      test::sphere_mesh({0, 0, 0}, 1, 30, 30), test::random_triangles(300, 1, 42)};
  std::uint32_t total = 0;
  for (const auto& mesh : meshes) {
    for (const float scale : {1e-4f, 1.0f, 1e4f}) {
      for (const float shift : {0.0f, 100.0f}) {
        const auto there = moved(mesh, scale, Vec3(shift * scale));
        for (const char* name : {"grid", "embree"}) {
          const auto accel = find_named(accelerators(), std::string_view(name)).value()(there, {});
          EXPECT_EQ(self_hits(*accel, there, rays), 0) << name << " scale " << scale << " shift " << shift;
          total += rays;
        }
      }
    }
  }
  std::printf("%u rays\n", total);
}

}  // namespace
}  // namespace lemma
