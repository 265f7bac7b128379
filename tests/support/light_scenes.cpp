#include "tests/support/light_scenes.h"

#include "tests/support/meshes.h"

namespace lemma::test {
namespace {

Scene glossy_floor() {
  Scene scene;
  scene.view = {{0, 0.9f, 2.2f}, {0, 0, 0.1f}, {0, 1, 0}, 35, 16, 16};
  scene.triangles = {{{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}}, {{-3, 0, -3}, {3, 0, 3}, {3, 0, -3}}};
  scene.facets = {{0, kNoEmitter}, {0, kNoEmitter}};
  scene.materials = {make_material({0.5f, 0.4f, 0.3f}, {0.3f, 0.3f, 0.3f}, 20)};
  scene.needs.model.specular = true;
  return scene;
}

void add_light(Scene& scene, const std::vector<Triangle>& triangles, float radiance) {
  const auto light = static_cast<std::uint32_t>(scene.needs.lights++);
  for (const Triangle& t : triangles) {
    const auto emitter = static_cast<std::uint32_t>(scene.emitters.size());
    const auto index = static_cast<std::uint32_t>(scene.triangles.size());
    scene.emitters.push_back({t, {radiance, radiance, radiance}, index, light});
    scene.facets.push_back({0, emitter});
    scene.triangles.push_back(t);
  }
  scene.needs.emitter_triangles = scene.emitters.size();
}

}  // namespace

Scene many_lights() {
  Scene scene = glossy_floor();
  auto triangles = random_triangles(10000, 0.02f, 141);
  for (Triangle& t : triangles) {
    for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = Vec3(2 * v->x - 1, 1.3f + 0.5f * v->y, 2 * v->z - 1);
  }
  add_light(scene, triangles, 20);
  return scene;
}

Scene overlapping_lights() {
  Scene scene = glossy_floor();
  add_light(scene, sphere_mesh({-0.2f, 1.5f, 0}, 0.4f, 10, 16), 5);
  add_light(scene, sphere_mesh({0.25f, 1.6f, 0.1f}, 0.35f, 8, 12), 11);
  add_light(scene, {{{-1, 1.55f, -0.2f}, {0.9f, 1.5f, -0.1f}, {0, 1.7f, 0.9f}}}, 3);
  return scene;
}

Scene light_below_horizon(bool block) {
  Scene scene = glossy_floor();
  if (block) {
    for (const Triangle& t : sphere_mesh({0.5f, 0.1f, -0.3f}, 0.3f, 3, 4)) {
      scene.triangles.push_back(t);
      scene.facets.push_back({0, kNoEmitter});
    }
  }
  add_light(scene, {{{-1, -0.7f, -1.1f}, {1.2f, -0.4f, -1.3f}, {0.2f, 1.4f, -1.2f}}}, 4);
  return scene;
}

}  // namespace lemma::test
