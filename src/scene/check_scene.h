#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/core/bounds.h"
#include "src/scene/load_scene.h"

namespace lemma {

/// A light as it was understood.
struct LightCheck {
  std::string name;    // of its material
  std::string source;  // what makes it one: "XML", "Ke", "Ka", "name"
  Rgb radiance;
  std::size_t triangles = 0;
  double area = 0;
  double power = 0;               // luminance of pi x area x radiance [W]
  std::optional<Vec3> direction;  // unit, the mean of its normals; nothing if it faces all round
  bool faces_away = false;        // no corner of what reflects lies on an emitting side
};

/// A material as it was understood.
struct MaterialCheck {
  std::string name;
  std::size_t triangles = 0;  // that can be rendered
  bool defined = true;        // in an MTL
  std::string meaning;        // "emits", "Lambert + Phong, texture wood.jpg", "glass, Ni 1.5, ..."
};

/// What there is to know about a scene before it is rendered.
struct SceneCheck {
  LoadedScene loaded;                // as far as it could be read
  std::optional<std::string> error;  // why it cannot be rendered, as load_scene() would throw it
  std::size_t vertices = 0;          // of the OBJ
  std::size_t duplicates = 0;        // triangles with the corners of another one, beyond the first
  std::size_t under_lights = 0;      // triangles with an emitter in their plane, on top of them
  Bounds bounds;                     // of all triangles
  std::vector<LightCheck> lights;
  std::vector<MaterialCheck> materials;
};

/// Reads a scene as load_scene() does, and looks at it. Does not throw for a scene that is unfit: the error
/// is in the result.
[[nodiscard]] SceneCheck check_scene(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lemma
