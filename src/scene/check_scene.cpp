#include "src/scene/check_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <tuple>

#include "src/scene/glass.h"
#include "src/scene/scene_parts.h"

namespace lemma {
namespace {

using Corner = std::tuple<float, float, float>;

/// The corners in an order that does not depend on how the triangle was written.
std::array<Corner, 3> sorted_corners(const Triangle& t) {
  const auto corner = [](const Vec3& v) { return Corner(v.x, v.y, v.z); };
  std::array<Corner, 3> corners{corner(t.v0), corner(t.v1), corner(t.v2)};
  std::ranges::sort(corners);
  return corners;
}

std::size_t count_duplicates(const std::vector<Triangle>& triangles) {
  std::vector<std::array<Corner, 3>> all;
  all.reserve(triangles.size());
  for (const Triangle& t : triangles) all.push_back(sorted_corners(t));
  std::ranges::sort(all);
  return static_cast<std::size_t>(all.end() - std::unique(all.begin(), all.end()));
}

Bounds bounds_of_reflecting(const Scene& scene) {
  Bounds bounds;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if (scene.facets[i].emitter == kNoEmitter) bounds.add(scene.triangles[i]);
  }
  return bounds;
}

/// Whether an emitter sends light into a box.
bool lights_box(const Emitter& e, const Bounds& box) {
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = ((corner >> k) & 1) != 0 ? box.hi[k] : box.lo[k];
    if (emits_towards(e, x)) return true;
  }
  return false;
}

/// A mean of unit normals this short has no direction: a sphere, or a box.
constexpr double kNoDirection = 0.05;

std::vector<LightCheck> check_lights(const Scene& scene, const SceneParts& parts) {
  std::vector<LightCheck> lights(scene.needs.lights);
  std::vector<Vec3d> normals(lights.size(), Vec3d(0));
  const Bounds reflecting = bounds_of_reflecting(scene);
  for (LightCheck& light : lights) light.faces_away = true;
  for (const Emitter& e : scene.emitters) {
    LightCheck& light = lights[e.light];
    const std::uint32_t material = scene.facets[e.triangle].material;
    light.name = parts.table.materials[material].name;
    light.source = parts.lights.lights[parts.lights.of_material[material]].source;
    light.radiance = e.radiance;
    ++light.triangles;
    light.area += area(e.shape);
    light.faces_away = light.faces_away && !lights_box(e, reflecting);
    normals[e.light] += area_vector(e.shape) * 0.5;
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lights[i].power = std::numbers::pi * lights[i].area * double{luminance(lights[i].radiance)};
    if (length(normals[i]) > kNoDirection * lights[i].area) lights[i].direction = Vec3(normalize(normals[i]));
  }
  return lights;
}

std::string text_of(const Rgb& c) {
  return fmt::format("{} {} {}", c.r, c.g, c.b);
}

std::string glass_meaning(const MtlMaterial& m) {
  constexpr std::array<std::string_view, 4> sources{"", "Tr of three numbers", "Tr or d of one number",
                                                    "by Ni alone"};
  MtlMaterial upright = m;
  upright.inside_out = false;
  return fmt::format("glass, Ni {}, transmittance {} ({}){}", m.ni, text_of(glass_of(upright).transmittance),
                     sources.at(static_cast<std::size_t>(transparency_of(m))),
                     m.inside_out ? ", winding turned round" : "");
}

/// What is in the file and has no effect.
std::string ignored(const MtlMaterial& m, bool emits) {
  std::string text;
  if (!m.tr.empty() && !is_glass(m)) text += fmt::format("; Tr {} means nothing", fmt::join(m.tr, " "));
  if (!emits && max_channel(m.ka) > 1)
    text += fmt::format("; Ka {} might be a radiance: --emission ka", text_of(m.ka));
  return text;
}

std::string surface_meaning(const MtlMaterial& m, const Scene& scene, std::uint32_t index) {
  if (is_glass(m)) return glass_meaning(m);
  std::string text = is_black(m.ks) ? "Lambert" : fmt::format("Lambert + Phong, Ns {}", m.ns);
  if (max_channel(m.kd + m.ks) > 1) text += ", Kd + Ks > 1";
  const bool shown = !scene.texture_of.empty() && scene.texture_of[index].texture != kNoTexture;
  if (!m.map_kd.empty()) text += fmt::format(", texture {}{}", m.map_kd, shown ? "" : " not to be had");
  return text + ignored(m, false);
}

std::vector<MaterialCheck> check_materials(const LoadedScene& loaded, const SceneParts& parts) {
  const Scene& scene = loaded.scene;
  std::vector<MaterialCheck> checks(parts.table.materials.size());
  std::vector<bool> emits(checks.size(), false);
  for (const Facet& facet : scene.facets) {
    ++checks[facet.material].triangles;
    emits[facet.material] = emits[facet.material] || facet.emitter != kNoEmitter;
  }
  for (std::uint32_t i = 0; i < checks.size(); ++i) {
    const MtlMaterial& m = parts.table.materials[i];
    checks[i].name = m.name;
    checks[i].defined = m.where.file != loaded.report.obj && m.where.file != loaded.report.xml;
    checks[i].meaning = emits[i]                  ? "emits" + ignored(m, true)
                        : checks[i].triangles > 0 ? surface_meaning(m, scene, i)
                                                  : "unused";
    if (!checks[i].defined) checks[i].meaning += ", not defined in any MTL";
  }
  return checks;
}

std::size_t count_under_lights(const Overlays& overlays) {
  return static_cast<std::size_t>(
      std::ranges::count_if(overlays.list_of, [](std::uint32_t list) { return list != Overlays::kNone; }));
}

}  // namespace

SceneCheck check_scene(const std::filesystem::path& path, const LoadOptions& options) {
  SceneCheck check;
  SceneParts parts;
  try {
    load_parts(path, options, parts, check.loaded);
    require_renderable(check.loaded, parts);
  } catch (const SceneError& error) {
    check.error = error.what();
  }
  const Scene& scene = check.loaded.scene;
  check.vertices = parts.obj.vertices.size();
  if (scene.facets.empty()) return check;
  check.duplicates = count_duplicates(scene.triangles);
  check.under_lights = count_under_lights(scene.overlays);
  check.bounds = bounds_of(scene.triangles);
  check.lights = check_lights(scene, parts);
  check.materials = check_materials(check.loaded, parts);
  return check;
}

}  // namespace lemma
