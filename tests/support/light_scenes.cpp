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

Scene glossy_room(const BrdfOptions& brdf) {
  Scene scene;
  scene.view = {{0.1f, 0.2f, 2.8f}, {0, -0.3f, 0}, {0, 1, 0}, 60, 16, 16};
  const auto grey = [&](float kd, float ks, float n) {
    return make_material({kd, kd, kd}, {ks, ks, ks}, n, brdf);
  };
  scene.materials = {grey(0.4f, 0.2f, 30), grey(0.2f, 0.45f, 3), grey(0.1f, 0.5f, 100), grey(0, 0.6f, 0)};
  const auto add = [&](const Triangle& t, std::uint32_t material) {
    scene.triangles.push_back(t);
    scene.facets.push_back({material, kNoEmitter});
  };
  const auto add_emitter = [&](const Triangle& t, float radiance, std::uint32_t light) {
    add(t, 0);
    scene.facets.back().emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({.shape = t,
                              .radiance = {radiance, radiance, radiance},
                              .triangle = static_cast<std::uint32_t>(scene.triangles.size() - 1),
                              .light = light});
  };
  for (const Triangle& t : inward_box({-1, -1, -1}, {1, 1, 3})) {
    const Vec3 n(area_vector(t));
    if (n.y < 0) {
      add_emitter(t, 1, 0);  // the ceiling
    } else {
      add(t, n.y > 0 ? 1 : n.x != 0 ? 2 : 0);
    }
  }
  const Vec3 corner(-0.4f, 0.6f, -0.4f), x(0.7f, 0, 0), z(0, 0, 0.9f);
  add_emitter({corner, corner + x, corner + z}, 3, 1);
  add_emitter({corner + x, corner + x + z, corner + z}, 3, 1);
  for (const Triangle& t : sphere_mesh({0.3f, -0.6f, 0.2f}, 0.35f, 6, 10)) add(t, 3);
  scene.overlays = find_overlays(scene.triangles, scene.emitters);
  scene.needs.model.overlays = !scene.overlays.empty();
  scene.needs.model.specular = true;
  scene.needs.lights = 2;
  scene.needs.emitter_triangles = scene.emitters.size();
  return scene;
}

void double_lights(Scene& scene) {
  for (const Emitter& e : std::vector(scene.emitters)) {
    Emitter copy = e;
    copy.triangle = static_cast<std::uint32_t>(scene.triangles.size());
    copy.radiance = e.radiance * 3;
    copy.light = 1;
    scene.triangles.push_back(e.shape);
    scene.facets.push_back(
        {scene.facets[e.triangle].material, static_cast<std::uint32_t>(scene.emitters.size())});
    scene.emitters.push_back(copy);
  }
  scene.overlays = find_overlays(scene.triangles, scene.emitters);
  scene.needs.model.overlays = true;
}

}  // namespace lemma::test
