#include "src/parity/ray_kinds.h"

#include <cmath>

#include "src/core/error_bound.h"
#include "src/core/frame.h"
#include "src/core/warp.h"

namespace lemma {
namespace {

std::uint32_t below(std::uint32_t n, Sampler& random) {
  return static_cast<std::uint32_t>((std::uint64_t{random.next_bits()} * n) >> 32);
}

Vec3 unit_cube(Sampler& random) {
  const Vec2 xy = random.next_2d();
  return {xy.x, xy.y, random.next()};
}

Vec3 unit_sphere(Sampler& random) {
  const Vec2 u = random.next_2d();
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}

/// 0 with either sign.
float zero(Sampler& random) {
  return random.next() < 0.5f ? 0.0f : -0.0f;
}

float one(Sampler& random) {
  return random.next() < 0.5f ? 1.0f : -1.0f;
}

/// 10 to a power uniform in [least, most].
float power_of_ten(float least, float most, Sampler& random) {
  return std::pow(10.0f, least + (most - least) * random.next());
}

const Vec3& corner(const Triangle& t, std::uint32_t i) {
  return i == 0 ? t.v0 : i == 1 ? t.v1 : t.v2;
}

/// Along an axis, the other components 0 or -0.
Vec3 axis_direction(int axis, Sampler& random) {
  Vec3 direction{zero(random), zero(random), zero(random)};
  direction[axis] = one(random);
  return direction;
}

}  // namespace

RayKind kind_of(std::uint32_t index) {
  const std::uint32_t slot = index % 20;
  return static_cast<RayKind>(slot < 12 ? slot / 4 : slot - 9);
}

RaySource::RaySource(const RayScene& scene, std::uint64_t seed)
    : scene_(scene), seed_(seed), box_(bounds_of(scene.triangles)), size_(box_.hi - box_.lo) {
  extent_ = max_norm(size_);
  if (extent_ == 0) extent_ = 1;
  for (int k = 0; k < 3; ++k) size_[k] = std::max(size_[k], 1e-2f * extent_);
}

Ray RaySource::draw(std::uint32_t index) const {
  Sampler random(seed_, index, 0);
  switch (kind_of(index)) {
    case RayKind::camera:
      return camera_ray(random);
    case RayKind::bounce:
      return leave(place_on_path(random), random);
    case RayKind::shadow:
      return shadow_ray(random);
    case RayKind::vertex:
      return vertex_ray(random);
    case RayKind::edge:
      return edge_ray(random);
    case RayKind::cell:
      return cell_ray(random);
    case RayKind::axis:
      return axis_ray(random);
    case RayKind::grazing:
      return grazing_ray(random);
    case RayKind::coplanar:
      return coplanar_ray(random);
    case RayKind::on_surface:
      return surface_ray(random);
    case RayKind::far:
      return far_ray(random);
  }
  return {};
}

RaySource::Place RaySource::any_place(Sampler& random) const {
  const std::uint32_t triangle = below(static_cast<std::uint32_t>(scene_.triangles.size()), random);
  const auto [b1, b2] = uniform_triangle(random.next_2d());
  return {triangle, b1, b2};
}

/// Where a path from the camera is after 0 to 3 diffuse bounces; any place if it leaves the scene before.
RaySource::Place RaySource::place_on_path(Sampler& random) const {
  const std::uint32_t bounces = below(4, random);
  Ray ray = camera_ray(random);
  for (std::uint32_t i = 0;; ++i) {
    const auto hit = scene_.walker->closest_hit(ray);
    if (!hit) return any_place(random);
    const Place place{hit->triangle, hit->b1, hit->b2};
    if (i == bounces) return place;
    ray = leave(place, random);
  }
}

Vec3d RaySource::point(const Place& place) const {
  return point_at(scene_.triangles[place.triangle], place.b1, place.b2);
}

/// Inside the box or beside it; half of the time where the camera is, if there is one.
Vec3 RaySource::any_origin(Sampler& random) const {
  if (scene_.camera && random.next() < 0.5f) return camera_ray(random).origin;
  return box_.lo + (unit_cube(random) * 2.0f - Vec3(0.5f)) * size_;
}

/// A diffuse bounce to either side, from the origin that the renderer would take.
Ray RaySource::leave(const Place& place, Sampler& random) const {
  const Triangle& triangle = scene_.triangles[place.triangle];
  const Vec3d normal = normalize(area_vector(triangle)) * static_cast<double>(one(random));
  const Frame frame = frame_around(Vec3(normal));
  return {offset_origin(point(place), normal, triangle), frame.to_world(cosine_hemisphere(random.next_2d()))};
}

Ray RaySource::camera_ray(Sampler& random) const {
  if (const Camera* camera = scene_.camera) {
    const Vec2 u = random.next_2d();
    return camera->ray_through(u.x * static_cast<float>(camera->width()),
                               u.y * static_cast<float>(camera->height()));
  }
  const Vec3 eye = box_.hi + size_ * Vec3(0.7f, 0.4f, 1.1f);
  return {eye, normalize(box_.lo + unit_cube(random) * size_ - eye)};
}

Ray RaySource::shadow_ray(Sampler& random) const {
  const Place place = place_on_path(random);
  const Ray bounce = leave(place, random);
  if (scene_.lights) {
    const Vec3d normal = area_vector(scene_.triangles[place.triangle]);
    const double side = std::copysign(1.0, dot(normal, Vec3d(bounce.direction)));
    const LightQuery query = scene_.lights->query(bounce.origin, Vec3(normalize(normal * side)));
    const auto light = scene_.lights->sample(query, random);
    if (light) return {bounce.origin, light->to_light, 0, light->visible_until};
  }
  return {bounce.origin, Vec3(point(any_place(random)) - Vec3d(bounce.origin)), 0, 0.999f};
}

Ray RaySource::vertex_ray(Sampler& random) const {
  const Vec3 origin = any_origin(random);
  const Triangle& t = scene_.triangles[any_place(random).triangle];
  return {origin, corner(t, below(3, random)) - origin};
}

Ray RaySource::edge_ray(Sampler& random) const {
  const Vec3 origin = any_origin(random);
  const Triangle& t = scene_.triangles[any_place(random).triangle];
  const std::uint32_t i = below(3, random);
  return {origin, (corner(t, i) + corner(t, (i + 1) % 3)) * 0.5f - origin};
}

/// The grid has about 8 cubic cells a triangle and begins at the scene's corner.
Ray RaySource::cell_ray(Sampler& random) const {
  const float cells = std::cbrt(8 * static_cast<float>(scene_.triangles.size()));
  const float cell = extent_ / std::max(1.0f, std::round(cells));
  const auto grid_corner = [&] {
    Vec3 p = unit_cube(random) * size_;
    for (int k = 0; k < 3; ++k) p[k] = box_.lo[k] + cell * std::round(p[k] / cell);
    return p;
  };
  const Vec3 origin = grid_corner();
  const std::uint32_t way = below(4, random);
  const int axis = static_cast<int>(below(3, random));
  if (way == 0) return {origin, axis_direction(axis, random)};
  if (way == 1) return {origin, Vec3{one(random), one(random), one(random)}};
  Vec3 direction = way == 2 ? unit_sphere(random) : grid_corner() - origin;
  direction[axis] = zero(random);
  if (direction == Vec3(0)) direction = axis_direction(axis, random);
  return {origin, direction};
}

Ray RaySource::axis_ray(Sampler& random) const {
  const int axis = static_cast<int>(below(3, random));
  Vec3 origin = box_.lo + (unit_cube(random) * 1.5f - Vec3(0.25f)) * size_;
  if (random.next() < 0.5f) {
    const Triangle& t = scene_.triangles[any_place(random).triangle];
    const Vec3& aim = corner(t, below(3, random));
    for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) origin[k] = aim[k];
  }
  return {origin, axis_direction(axis, random)};
}

Ray RaySource::grazing_ray(Sampler& random) const {
  const Place place = any_place(random);
  const Frame frame = frame_around(geometric_normal(scene_.triangles[place.triangle]));
  const float phi = 2 * kPi * random.next();
  const Vec3 direction = frame.s * std::cos(phi) + frame.t * std::sin(phi) +
                         frame.n * (one(random) * power_of_ten(-7, -1, random));
  const float back = extent_ * power_of_ten(-3, 0, random);
  return {Vec3(point(place)) - direction * back, direction};
}

Ray RaySource::coplanar_ray(Sampler& random) const {
  const Place from = any_place(random);
  const auto in_plane = [&] {
    return Vec3(point({from.triangle, 4.0 * random.next() - 2, 4.0 * random.next() - 2}));
  };
  const Vec3 origin = in_plane();
  return {origin, in_plane() - origin};
}

Ray RaySource::surface_ray(Sampler& random) const {
  const Place place = any_place(random);
  const bool at_vertex = random.next() < 0.25f;
  const Vec3 origin = at_vertex ? scene_.triangles[place.triangle].v0 : Vec3(point(place));
  return {origin, unit_sphere(random)};
}

Ray RaySource::far_ray(Sampler& random) const {
  const Vec3 target(point(any_place(random)));
  const Vec3 origin = target + unit_sphere(random) * (extent_ * power_of_ten(1, 4, random));
  return {origin, target - origin};
}

}  // namespace lemma
