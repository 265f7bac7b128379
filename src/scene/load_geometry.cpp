#include "src/scene/load_geometry.h"

#include <fmt/format.h>

#include "src/scene/obj_shape.h"
#include "src/scene/scene_files.h"

namespace lemma {

Geometry load_geometry(const std::filesystem::path& path) {
  const std::filesystem::path file = find_obj(path);
  Geometry geometry;
  const ObjFile obj = read_obj(file, geometry.warnings);
  for (std::uint32_t i = 0; i < obj.triangles.size(); ++i) {
    const Triangle shape = shape_of(obj, obj.triangles[i]);
    if (soundness_of(shape) != Soundness::sound) continue;
    geometry.triangles.push_back(shape);
    geometry.file_index.push_back(i);
  }
  if (geometry.triangles.empty()) {
    throw SceneError({file}, fmt::format("no triangle can be used, of {} read", obj.triangles.size()),
                     "the faces need three corners that are not in line");
  }
  return geometry;
}

}  // namespace lemma
