#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "src/core/vec.h"
#include "src/scene/messages.h"

namespace lemma {

inline constexpr std::uint32_t kNoNormal = 0xFFFFFFFFu;

/// A triangle of the file, by 0-based indices that are in range.
struct ObjTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<std::uint32_t, 3> normal{kNoNormal, kNoNormal, kNoNormal};
  std::uint32_t material = 0;  // index into ObjFile::materials
};

/// A name the file uses, and where first.
struct ObjName {
  std::string name;
  FilePosition where;
};

/// The geometry of an OBJ file as written: nothing dropped, nothing normalised.
struct ObjFile {
  std::vector<Vec3> vertices;          // NaN where the file says so
  std::vector<Vec3> normals;           // of any length; NaN where the file says so
  std::vector<ObjTriangle> triangles;  // in file order, polygons as fans around their first corner
  std::vector<ObjName> materials;      // each name of usemtl; an empty one for faces before the first
  std::vector<ObjName> libraries;      // the text of each mtllib line, which may hold several file names
};

/// Reads vertices, normals, faces and the names of materials; texture coordinates, groups, lines and points
/// are left out. Faces with fewer than three corners and coordinates that are not finite are warned of.
/// @throw SceneError with the line if the file cannot be read, an index is 0 or out of range, or numbers are
/// missing
[[nodiscard]] ObjFile read_obj(const std::filesystem::path& path, Warnings& warnings);

}  // namespace lemma
