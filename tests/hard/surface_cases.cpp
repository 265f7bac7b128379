#include "src/core/error_bound.h"
#include "src/core/frame.h"
#include "src/core/parallel.h"
#include "src/core/warp.h"
#include "src/lights/light_sampler.h"
#include "tests/hard/hard_case.h"
#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma::test {
namespace {

struct SurfacePoint {
  Vec3d position, normal;
  const Triangle* triangle;
};

SurfacePoint random_surface_point(const std::vector<Triangle>& mesh, Sampler& random) {
  const Triangle& t = mesh[random.next_bits() % mesh.size()];
  const auto [b1, b2] = uniform_triangle(random.next_2d());
  return {point_at(t, b1, b2), normalize(area_vector(t)), &t};
}

Vec3 origin_above(const SurfacePoint& p) {
  return offset_origin(p.position, p.normal, *p.triangle);
}

/// 12: rays that leave a plane, a convex sphere and a plane far off, a third of them within 1e-4 of the
/// horizon, never hit anything again.
Outcome self_hits(std::string_view backend) {
  Outcome outcome;
  const Vec3 far(3000, -7000, 500);
  const std::vector<Triangle> plane{{{-20, -0.5f, -20}, {20, 0.25f, -20}, {0, 0, 20}}},
      far_plane{{plane[0].v0 + far, plane[0].v1 + far, plane[0].v2 + far}};
  for (const auto& mesh : {plane, far_plane, sphere_mesh({2, 1, 0}, 1, 20, 20)}) {
    const auto accel = make_backend(backend, mesh);
    for (std::uint32_t i = 0; i < 100000; ++i) {
      Sampler random(81, i, 0);
      const SurfacePoint p = random_surface_point(mesh, random);
      Vec3 local = cosine_hemisphere(random.next_2d());
      if (i % 3 == 0) local.z = std::max(1e-7f, 1e-4f * random.next());
      const Ray ray{origin_above(p), frame_around(Vec3(p.normal)).to_world(local)};
      ++outcome.rays;
      outcome.faults += accel->closest_hit(ray) || accel->occluded(ray) ? 1 : 0;
    }
  }
  return outcome;
}

/// 13: between plates of size 10 that are 1e-4 apart; rays that tunnel through the one they face, or hit the
/// one they leave.
Outcome thin_gap(std::string_view backend) {
  const std::vector<Triangle> plates{{{-10, 0, -10}, {0, 0, 20}, {10, 0, -10}},
                                     {{-10, 1e-4f, -10}, {10, 1e-4f, -10}, {0, 1e-4f, 20}}};
  const auto accel = make_backend(backend, plates);
  Outcome outcome;
  for (std::uint32_t i = 0; i < 50000; ++i) {
    Sampler random(82, i, 0);
    const auto [b1, b2] = uniform_triangle(random.next_2d());
    const Vec3d position = point_at(plates[0], 0.1 + 0.8 * b1, 0.1 + 0.8 * b2);
    const Vec3d up(0, 1, 0);
    const Vec3 local = cosine_hemisphere(random.next_2d());
    if (local.z < 0.01f) continue;  // those may leave at the side
    const auto hit =
        accel->closest_hit({offset_origin(position, up, plates[0]), frame_around({0, 1, 0}).to_world(local)});
    ++outcome.rays;
    outcome.faults += hit && hit->triangle == 1 ? 0 : 1;
  }
  return outcome;
}

/// Light samples from points of a receiver that nothing stands in the way of: those that are blocked.
Outcome blocked_samples(std::string_view backend, const std::vector<Triangle>& triangles,
                        const std::vector<Emitter>& emitters, const std::vector<Triangle>& receiver) {
  const auto accel = make_backend(backend, triangles);
  Outcome outcome;
  for (const auto& strategy : light_samplers()) {
    const auto lights = strategy.value(emitters, {});
    for (std::uint32_t i = 0; i < 20000; ++i) {
      Sampler random(83, i, 0);
      const SurfacePoint p = random_surface_point(receiver, random);
      const Vec3 origin = origin_above(p);
      const auto light = lights->sample(lights->query(origin, Vec3(p.normal)), random);
      if (!light) continue;
      ++outcome.rays;
      outcome.faults += accel->occluded(Ray{origin, light->to_light, 0, light->visible_until}) ? 1 : 0;
    }
  }
  return outcome;
}

std::vector<Emitter> as_emitters(const std::vector<Triangle>& light, std::uint32_t first) {
  std::vector<Emitter> emitters;
  for (const Triangle& t : light) emitters.push_back({t, {1, 1, 1}, first++, 0});
  return emitters;
}

/// A square in the plane y = height, facing down.
std::vector<Triangle> facing_down(float half, float height) {
  const Vec3 a(-half, height, -half), b(half, height, -half), c(half, height, half), d(-half, height, half);
  return {{a, b, c}, {a, c, d}};
}

std::vector<Triangle> facing_up(float half, float height) {
  std::vector<Triangle> square = facing_down(half, height);
  for (Triangle& t : square) std::swap(t.v1, t.v2);
  return square;
}

/// A floor under a light under a ceiling.
Outcome light_under_ceiling(std::string_view backend, float half, float light_height, float ceiling_height) {
  std::vector<Triangle> triangles = facing_up(half, 0);
  const auto receiver = triangles, light = facing_down(half / 5, light_height),
             ceiling = facing_down(half, ceiling_height);
  triangles.insert(triangles.end(), ceiling.begin(), ceiling.end());
  const auto first = static_cast<std::uint32_t>(triangles.size());
  triangles.insert(triangles.end(), light.begin(), light.end());
  return blocked_samples(backend, triangles, as_emitters(light, first), receiver);
}

/// 14: a light of many triangles, so that samples lie near shared edges, seen from a plane down to grazing.
Outcome shadow_ray_ends(std::string_view backend) {
  std::vector<Triangle> light;
  for (const Triangle& t : facing_down(1, 3)) {
    for (int i = 0; i < 20; ++i) {  // a fan of slivers
      const auto at = [&](int k) { return t.v1 + (t.v2 - t.v1) * (static_cast<float>(k) / 20); };
      light.push_back({t.v0, at(i), at(i + 1)});
    }
  }
  std::vector<Triangle> triangles = facing_up(30, 2.9f);  // seen at a cosine of 3e-3 from its far parts
  const auto receiver = triangles;
  triangles.insert(triangles.end(), light.begin(), light.end());
  return blocked_samples(backend, triangles, as_emitters(light, 2), receiver);
}

Outcome coplanar_light(std::string_view backend) {
  return light_under_ceiling(backend, 278, 548.8f, 548.8f);
}

/// As in the staircase of 2022: 4.1e-5 below the ceiling of a scene of size 42.
Outcome light_close_to_the_ceiling(std::string_view backend) {
  return light_under_ceiling(backend, 21, 11.99996f, std::nextafter(12.0f, 13.0f));
}

/// 23: pixels that differ between 1, 2, 7 and 16 threads.
Outcome threads(std::string_view backend) {
  const Scene scene = own_scene("cornell-coplanar", 48, 48);
  const RenderSettings settings{.spp = 4, .seed = 84};
  const auto with_threads = [&](int count) {
    const ThreadLimit limit(count);
    return render_scene(scene, {backend}, settings).image;
  };
  const Image one = with_threads(1);
  Outcome outcome;
  for (const int count : {2, 7, 16}) {
    outcome.rays += one.pixels.size();
    outcome.faults += differing_pixels(one, with_threads(count));
  }
  return outcome;
}

}  // namespace

std::span<const HardCase> surface_cases() {
  static constexpr HardCase cases[] = {
      {"12 rays that leave surfaces, grazing", "none hits its own", self_hits, true},
      {"13 plates 1e-4 apart", "no tunnelling", thin_gap, true},
      {"14 ends of shadow rays", "no sample is blocked", shadow_ray_ends, true},
      {"light in the plane of the ceiling", "no sample is blocked", coplanar_light, true},
      {"light 4.1e-5 below the ceiling of 42", "no sample is blocked", light_close_to_the_ceiling, true},
      {"23 threads 1, 2, 7, 16", "the same pixels", threads, true}};
  return cases;
}

}  // namespace lemma::test
