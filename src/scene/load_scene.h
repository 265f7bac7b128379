#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "src/core/named.h"
#include "src/scene/scene.h"

namespace lemma {

/// What makes the faces of a material emit.
enum class EmissionRule {
  declared,  // a <light> of the XML, else Ke
  ka,        // as declared; of the rest Ka, where it is above 1 in some channel (a dialect of 2019)
  name       // as ka; the rest emits 1 1 1 if its name holds "light"
};

[[nodiscard]] std::span<const Named<EmissionRule>> emission_rules();

struct LoadOptions {
  BrdfOptions brdf;
  EmissionRule emission = EmissionRule::declared;
  TextureRule textures = TextureRule::replace;
};

/// What was read and what became of it.
struct LoadReport {
  std::filesystem::path xml, obj;
  std::string dialect;  // of the XML
  std::vector<std::filesystem::path> mtl;
  std::size_t triangles_read = 0;      // polygons as fans
  std::size_t dropped_zero_area = 0;   // triangles whose area is exactly 0
  std::size_t dropped_non_finite = 0;  // triangles with a vertex that is NaN, infinite or beyond 1e18
  std::size_t opposed_normals = 0;     // triangles whose vertex normals oppose their winding
  std::size_t without_texcoords = 0;   // triangles of textured materials that have no texture coordinates
  std::vector<std::string> warnings;   // each "file[:line[:column]]: warning: what"
};

struct LoadedScene {
  Scene scene;
  LoadReport report;
};

/// Reads a scene of the course format: an XML file (camera, lights by material name) beside an OBJ and its
/// MTL.
/// @param path  the XML, the OBJ, or the folder that holds both
/// @throw SceneError if there is nothing that can be rendered
[[nodiscard]] LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// One line: files, counts, lights, what was dropped.
[[nodiscard]] std::string describe(const LoadedScene& loaded);

}  // namespace lemma
