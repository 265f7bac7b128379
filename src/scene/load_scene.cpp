#include "src/scene/load_scene.h"

#include <fmt/format.h>

#include "src/scene/geometry.h"
#include "src/scene/glass.h"
#include "src/scene/material_textures.h"
#include "src/scene/read_xml.h"
#include "src/scene/scene_files.h"
#include "src/scene/scene_parts.h"
#include "src/scene/spheres.h"

namespace lemma {
namespace {

/// Of each material, whether there is a triangle with it that reflects.
std::vector<bool> find_reflecting(const Scene& scene, std::size_t materials) {
  std::vector<bool> reflects(materials, false);
  for (const Facet& facet : scene.facets) {
    if (facet.emitter == kNoEmitter) reflects[facet.material] = true;
  }
  return reflects;
}

bool any_specular(const std::vector<MtlMaterial>& materials, const std::vector<bool>& reflects) {
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (reflects[i] && !is_glass(materials[i]) && !is_black(materials[i].ks)) return true;
  }
  return false;
}

/// The boundaries of glass, if a triangle has one.
void find_glass(const std::vector<MtlMaterial>& materials, const std::vector<bool>& shown, Scene& scene) {
  for (std::size_t i = 0; i < materials.size(); ++i) {
    scene.needs.model.glass |= shown[i] && is_glass(materials[i]);
    scene.glass.push_back(glass_of(materials[i]));
  }
  if (!scene.needs.model.glass) scene.glass.clear();
}

}  // namespace

void load_parts(const std::filesystem::path& path, const LoadOptions& options, SceneParts& parts,
                LoadedScene& loaded) {
  auto& [scene, report] = loaded;
  auto& [obj, table, lights] = parts;
  const SceneFiles files = find_scene_files(path);
  report.xml = files.xml;
  report.obj = files.obj;
  const XmlScene xml = read_xml(files.xml, report.warnings);
  report.dialect = xml.dialect;
  obj = read_obj(files.obj, report.warnings);
  add_spheres(xml.spheres, obj);
  report.mtl = find_mtl_files(files.obj, obj.libraries, report.warnings);
  table = read_materials(report.mtl, obj.materials, report.warnings);
  lights = find_lights(xml, table.materials, options.emission, report.warnings);

  scene.view = xml.view;
  build_geometry(obj, lights, table, scene, report);
  number_lights(lights, table.materials, scene, report.warnings);
  const std::vector<bool> reflects = find_reflecting(scene, table.materials.size());
  scene.materials = make_materials(table.materials, reflects, options.brdf, report.warnings);
  if (!scene.emitters.empty()) scene.overlays = find_overlays(scene.triangles, scene.emitters);
  scene.needs.model.overlays = !scene.overlays.empty();
  scene.needs.model.specular = any_specular(table.materials, reflects);
  find_glass(table.materials, reflects, scene);
  load_textures(table.materials, reflects, files.obj, options.textures, scene, report.warnings);
  if (report.without_texcoords > 0) {
    warn(report.warnings, {files.obj},
         fmt::format(
             "{} triangles with a texture have no texture coordinates; Kd stands in its place, or grey 0.5",
             report.without_texcoords));
  }
}

void require_renderable(const LoadedScene& loaded, const SceneParts& parts) {
  const auto& [scene, report] = loaded;
  if (scene.triangles.empty()) {
    throw SceneError({report.obj},
                     fmt::format("no triangle can be rendered, of {} read", report.triangles_read),
                     "the faces need three corners that are not in line");
  }
  if (!scene.emitters.empty()) return;
  const std::vector<MtlMaterial>& materials = parts.table.materials;
  throw no_emitters({report.xml}, materials, find_reflecting(scene, materials.size()));
}

LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options) {
  LoadedScene loaded;
  SceneParts parts;
  load_parts(path, options, parts, loaded);
  require_renderable(loaded, parts);
  return loaded;
}

}  // namespace lemma
