#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "src/core/triangle.h"

namespace lemma {

/// The triangles of a scene without camera, lights and materials, as accelerators get them.
struct Geometry {
  std::vector<Triangle> triangles;        // without the dropped ones; order and winding of the file
  std::vector<std::uint32_t> file_index;  // for each its number in the OBJ: polygons as fans, all counted
  std::vector<std::string> warnings;      // each "file[:line[:column]]: warning: what"
};

/// Reads the OBJ of a scene alone. The triangles are those of load_scene().
/// @param path  the OBJ, the XML beside it, or the folder that holds it
/// @throw SceneError if it cannot be read or has no triangle
[[nodiscard]] Geometry load_geometry(const std::filesystem::path& path);

}  // namespace lemma
