#include "tests/support/lights.h"

#include "tests/support/meshes.h"

namespace lemma::test {
namespace {

/// The part of a polygon above the horizon (Sutherland and Hodgman).
std::vector<Vec3d> above_horizon(const std::vector<Vec3d>& polygon, const Vec3d& n) {
  std::vector<Vec3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = dot(n, a), at_b = dot(n, b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
      kept.push_back((a * at_b - b * at_a) * (1 / (at_b - at_a)));
    }
  }
  return kept;
}

}  // namespace

std::vector<Emitter> emitters_of(const std::vector<Triangle>& triangles, float radiance,
                                 std::uint32_t light) {
  std::vector<Emitter> emitters;
  for (const Triangle& t : triangles) {
    emitters.push_back(
        {t, {radiance, radiance, radiance}, static_cast<std::uint32_t>(emitters.size()), light});
  }
  return emitters;
}

std::vector<Emitter> two_spheres() {
  auto emitters = emitters_of(sphere_mesh({0, 2, 0}, 0.5f, 6, 8), 3, 0);
  for (const Emitter& e : emitters_of(sphere_mesh({2, 2, 1}, 0.1f, 6, 8), 40, 1)) emitters.push_back(e);
  return emitters;
}

double irradiance(const Emitter& emitter, const Vec3& x, const Vec3& n) {
  if (!emits_towards(emitter, x)) return 0;
  const Triangle& t = emitter.shape;
  const auto v =
      above_horizon({Vec3d(t.v0) - Vec3d(x), Vec3d(t.v1) - Vec3d(x), Vec3d(t.v2) - Vec3d(x)}, Vec3d(n));
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3d &a = v[i], &b = v[(i + 1) % v.size()];
    const Vec3d c = cross(a, b);
    if (length(c) > 0) sum += std::atan2(length(c), dot(a, b)) * dot(Vec3d(n), c) / length(c);
  }
  return emitter.radiance.g * std::abs(sum) / 2;
}

LightDraws::LightDraws(const LightSampler& lights, std::span<const Emitter> emitters) : lights_(lights) {
  for (const Emitter& e : emitters) triangles_.push_back(e.shape);
  accel_ = find_named(accelerators(), std::string_view("grid")).value()(triangles_, {});
}

std::optional<LightSample> LightDraws::operator()(const LightQuery& at, Sampler& random) const {
  auto sample = lights_.sample(at, random);
  if (!sample || sample->whole == nullptr) return sample;
  // Other lights may stand before it.
  Ray ray{at.x, sample->wi};
  for (auto hit = accel_->closest_hit(ray); hit; hit = accel_->closest_hit(ray)) {
    if (lights_.whole_of(hit->triangle) == sample->whole) {
      sample->emitter = hit->triangle;
      sample->to_light = sample->wi * hit->t;
      return sample;
    }
    ray.t_min = hit->t;
  }
  return std::nullopt;
}

}  // namespace lemma::test
