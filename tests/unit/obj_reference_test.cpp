// Our OBJ reader against tinyobjloader's, which is another program: the same geometry from every file that
// both take.

#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include <array>
#include <fstream>

#include "src/scene/read_obj.h"
#include "tests/support/real_scenes.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

struct Reference {
  std::vector<tinyobj::real_t> vertices, normals, texcoords;
  std::vector<std::array<tinyobj::index_t, 3>> triangles;  // polygons as fans
};

/// Faces of all shapes, which stand in the order of the file.
Reference read_by_library(const fs::path& path) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  std::ifstream file(path);
  // A null reader of materials: their names alone would need the MTL file.
  EXPECT_TRUE(tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, &file, nullptr, false))
      << path << errors;
  Reference read{attributes.vertices, attributes.normals, attributes.texcoords, {}};
  for (const tinyobj::shape_t& shape : shapes) {
    const tinyobj::index_t* corners = shape.mesh.indices.data();
    for (const auto count : shape.mesh.num_face_vertices) {
      for (unsigned k = 2; k < count; ++k) read.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      corners += count;
    }
  }
  return read;
}

int as_written(std::uint32_t index) {
  return index == kNoIndex ? -1 : static_cast<int>(index);
}

/// Decimal fractions are read by different routines: the library's takes the digits as a whole number and a
/// power of ten in double, each rounded once or twice, then rounds to float32: at most one unit in the last
/// place off.
template <class Vector>
void expect_numbers(const std::vector<Vector>& ours, const std::vector<tinyobj::real_t>& theirs, int size) {
  ASSERT_EQ(ours.size() * static_cast<std::size_t>(size), theirs.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const float a = ours[i / static_cast<std::size_t>(size)][static_cast<int>(i) % size];
    if (std::abs(a - theirs[i]) > std::abs(a) * 0x1p-23f) ++different;
  }
  EXPECT_EQ(different, 0u);
}

void expect_same_geometry(const fs::path& path) {
  SCOPED_TRACE(path.string());
  Warnings warnings;
  const ObjFile ours = read_obj(path, warnings);
  const Reference theirs = read_by_library(path);
  expect_numbers(ours.vertices, theirs.vertices, 3);
  expect_numbers(ours.normals, theirs.normals, 3);
  expect_numbers(ours.texcoords, theirs.texcoords, 2);
  ASSERT_EQ(ours.triangles.size(), theirs.triangles.size());
  std::size_t different = 0;
  for (std::size_t t = 0; t < ours.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const tinyobj::index_t& corner = theirs.triangles[t][k];
      const ObjTriangle& own = ours.triangles[t];
      different += as_written(own.vertex[k]) != corner.vertex_index ||
                           as_written(own.normal[k]) != corner.normal_index ||
                           as_written(own.texcoord[k]) != corner.texcoord_index
                       ? 1
                       : 0;
    }
  }
  EXPECT_EQ(different, 0u);
}

TEST(ObjReference, OurScenes) {
  for (const char* scene :
       {"veach-mis/veach-mis.obj", "cornell-box/cornell-box.obj", "cornell-coplanar/cornell-coplanar.obj"}) {
    expect_same_geometry(fs::path(LEMMA_SCENES) / scene);
  }
}

TEST(ObjReference, PolygonsNegativeIndicesAndMissingParts) {
  const fs::path path = fs::path(testing::TempDir()) / "lemma_obj_reference.obj";
  std::ofstream(path)
      << "v 0 0 0\nv 1.25e-3 0 0\nv 1 1 +.5\nv 0 1 -2\nv -1 0.1 7\nvn 0 0 1\nvn 0 1 0\nvt 0.5 0.25\n"
         "f 1 2 3 4 5\nf -5//1 -4//2 -3//-1\ng other\nf 1/1 2/1 3/1\nf 1/1/1 2/-1/2 3/1/-2 4/1/1\n";
  expect_same_geometry(path);
  fs::remove(path);
}

TEST(ObjReference, ScenesOfTheCourse) {
  const auto folder = test::real_scenes();
  if (!folder) GTEST_SKIP() << test::kNoRealScenes;
  int files = 0;
  for (const auto& entry : fs::directory_iterator(*folder)) {
    if (!entry.path().filename().string().starts_with("zju-")) continue;
    for (const auto& file : fs::directory_iterator(entry.path())) {
      if (file.path().extension() != ".obj") continue;
      expect_same_geometry(file.path());
      ++files;
    }
  }
  EXPECT_GE(files, 3);
}

}  // namespace
}  // namespace lemma
