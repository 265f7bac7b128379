#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/vec.h"
#include "src/scene/messages.h"

namespace lemma {

inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFu;

/// A triangle of the file, by 0-based indices that are in range.
struct ObjTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<std::uint32_t, 3> normal{kNoIndex, kNoIndex, kNoIndex};
  std::array<std::uint32_t, 3> texcoord{kNoIndex, kNoIndex, kNoIndex};
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
  std::vector<Vec2> texcoords;         // v upwards; NaN where the file has no numbers
  std::vector<ObjTriangle> triangles;  // in file order, polygons as fans around their first corner
  std::vector<ObjName> materials;      // each name of usemtl; an empty one for faces before the first
  std::vector<ObjName> libraries;      // the text of each mtllib line, which may hold several file names
};

/// What is refused because the machine cannot hold it.
struct ObjLimits {
  std::uint64_t bytes = 0;      // of the text
  std::uint64_t triangles = 0;  // below 2^32 - 1, as all indices are

  /// By the memory of the machine.
  [[nodiscard]] static ObjLimits of_machine();
};

/// Reads vertices, normals, texture coordinates, faces and the names of materials; groups, lines and points
/// are left out. Faces with fewer than three corners and coordinates that are not finite are warned of.
/// @throw SceneError with the line if the file cannot be read, an index is 0 or out of range, numbers are
/// missing, or the limits are passed
[[nodiscard]] ObjFile read_obj(const std::filesystem::path& path, Warnings& warnings,
                               const ObjLimits& limits = ObjLimits::of_machine());

/// The same for a text that is in memory already.
/// @param path  what messages call it
[[nodiscard]] ObjFile parse_obj(const std::filesystem::path& path, std::string_view text, Warnings& warnings,
                                const ObjLimits& limits = ObjLimits::of_machine());

}  // namespace lemma
