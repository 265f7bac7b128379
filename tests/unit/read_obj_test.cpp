#include "src/scene/read_obj.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

class ReadObj : public testing::Test {
 protected:
  ObjFile read(std::string_view text) { return read_obj(folder_.write("a.obj", text), warnings_); }

  std::string error_of(std::string_view text) {
    return folder_.error_of([&] { (void)read(text); });
  }

  std::string warning(std::size_t i) const { return folder_.plain(warnings_.at(i)); }

  test::SceneFolder folder_;
  Warnings warnings_;
};

using Indices = std::array<std::uint32_t, 3>;
constexpr std::string_view kFourVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string with_four_vertices(std::string_view rest) {
  return std::string(kFourVertices).append(rest);
}

TEST_F(ReadObj, VerticesNormalsAndMaterials) {
  const ObjFile obj = read(
      "mtllib a b.mtl\nv 1 2 3\nv -.5 1e-2 +4 0.7\nv 7 8 9 1 0 0\nvn 0 0 2\nusemtl red\nf 1//1 2//1 3//1\n"
      "usemtl blue\nusemtl red\nf 1 2 3\n");
  EXPECT_EQ(obj.vertices, (std::vector<Vec3>{{1, 2, 3}, {-.5f, 1e-2f, 4}, {7, 8, 9}}));
  EXPECT_EQ(obj.normals, std::vector<Vec3>{Vec3(0, 0, 2)});
  ASSERT_EQ(obj.triangles.size(), 2u);
  EXPECT_EQ(obj.triangles[0].vertex, (Indices{0, 1, 2}));
  EXPECT_EQ(obj.triangles[0].normal, (Indices{0, 0, 0}));
  EXPECT_EQ(obj.triangles[1].normal, (Indices{kNoIndex, kNoIndex, kNoIndex}));
  ASSERT_EQ(obj.materials.size(), 2u);
  EXPECT_EQ(obj.materials[0].name, "red");
  EXPECT_EQ(obj.materials[0].where.line, 6);
  EXPECT_EQ(obj.materials[1].name, "blue");
  EXPECT_EQ(obj.triangles[0].material, 0u);
  EXPECT_EQ(obj.triangles[1].material, 0u);
  ASSERT_EQ(obj.libraries.size(), 1u);
  EXPECT_EQ(obj.libraries[0].name, "a b.mtl");
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadObj, PolygonsBecomeFansInFileOrder) {
  const ObjFile obj = read(with_four_vertices("v -1 .5 0\nf 1 2 3 4 5\nf 2 3 4\n"));
  ASSERT_EQ(obj.triangles.size(), 4u);
  EXPECT_EQ(obj.triangles[0].vertex, (Indices{0, 1, 2}));
  EXPECT_EQ(obj.triangles[1].vertex, (Indices{0, 2, 3}));
  EXPECT_EQ(obj.triangles[2].vertex, (Indices{0, 3, 4}));
  EXPECT_EQ(obj.triangles[3].vertex, (Indices{1, 2, 3}));
}

TEST_F(ReadObj, FansCarryNormalsAndMissingOnes) {
  const ObjFile obj = read(with_four_vertices("vn 1 0 0\nvn 0 1 0\nvn 0 0 1\nf 1//3 2/9/2 3/9 4//1\n"));
  EXPECT_EQ(obj.triangles[0].texcoord, (Indices{kNoIndex, kNoIndex, kNoIndex}));
  EXPECT_EQ(warning(0),
            "FOLDER/a.obj:8: warning: a face uses a texture coordinate that is not defined before it (2 in "
            "all); its "
            "triangles have no texture");
  ASSERT_EQ(obj.triangles.size(), 2u);
  EXPECT_EQ(obj.triangles[0].normal, (Indices{2, 1, kNoIndex}));
  EXPECT_EQ(obj.triangles[1].normal, (Indices{2, kNoIndex, 0}));
}

TEST_F(ReadObj, NegativeIndicesCountFromTheCurrentEnd) {
  const ObjFile obj = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf -3//-1 -2//-1 -1//-1\n"
      "v 5 0 0\nv 6 0 0\nv 5 1 0\nvn 1 0 0\nf -3//-1 -2//-2 -1//1\n");
  ASSERT_EQ(obj.triangles.size(), 2u);
  EXPECT_EQ(obj.triangles[0].vertex, (Indices{0, 1, 2}));
  EXPECT_EQ(obj.triangles[1].vertex, (Indices{3, 4, 5}));
  EXPECT_EQ(obj.triangles[1].normal, (Indices{1, 0, 0}));
}

TEST_F(ReadObj, CommentsLineEndsByteOrderMarkAndContinuations) {
  const ObjFile obj = read(
      "\xEF\xBB\xBFv 0 0 0 # origin\r\nv 1 0 0\r\n\tv\t1 1 0\r\n\r\nf 1 2 3 # front\r\n"
      "f 1 \\\r\n 2 3#back\r\nusemtl  odd name \r\nf 3 2 1");
  ASSERT_EQ(obj.vertices.size(), 3u);
  ASSERT_EQ(obj.triangles.size(), 3u);
  EXPECT_EQ(obj.triangles[1].vertex, (Indices{0, 1, 2}));
  EXPECT_EQ(obj.triangles[2].vertex, (Indices{2, 1, 0}));
  ASSERT_EQ(obj.materials.size(), 2u);
  EXPECT_EQ(obj.materials[1].name, "odd name");
  EXPECT_EQ(obj.materials[1].where.line, 8);
}

TEST_F(ReadObj, FacesBeforeAnyUsemtlHaveTheEmptyName) {
  const ObjFile obj = read(with_four_vertices("f 1 2 3\nusemtl a\nf 1 2 3\n"));
  ASSERT_EQ(obj.materials.size(), 2u);
  EXPECT_EQ(obj.materials[0].name, "");
  EXPECT_EQ(obj.materials[0].where.line, 5);
  EXPECT_EQ(obj.triangles[1].material, 1u);
}

TEST_F(ReadObj, OtherElementsAreLeftOut) {
  const ObjFile obj =
      read(with_four_vertices("vt 0 0\ng\ng a b\no thing\ns 1\nl 1 2\np 1\nvp 1\ncurv 0 1\nf 1 2 3\n"));
  EXPECT_EQ(obj.vertices.size(), 4u);
  EXPECT_EQ(obj.triangles.size(), 1u);
}

TEST_F(ReadObj, NonFiniteVerticesAreKeptAsNanAndWarnedOf) {
  const ObjFile obj =
      read("v nan 0 0\nv 0 -inf 0\nv -1.#IND00 0 0\nv 0 0 2e18\nv 0 0 1e999\nv 1e-999 0 +1\nf 1 2 3\n");
  ASSERT_EQ(obj.vertices.size(), 6u);
  EXPECT_EQ(obj.vertices[5], Vec3(0, 0, 1));
  for (int i : {0, 1, 2}) EXPECT_TRUE(std::isnan(obj.vertices[static_cast<std::size_t>(i)].x)) << i;
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warning(0),
            "FOLDER/a.obj:1: warning: a vertex is not finite or beyond 1e18 (5 in all); triangles that use "
            "one are dropped");
}

TEST_F(ReadObj, FacesWithTwoCornersAreLeftOutWithAWarning) {
  const ObjFile obj = read(with_four_vertices("f 1\nf 1 2\nf 1 2 3\n"));
  EXPECT_EQ(obj.triangles.size(), 1u);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warning(0),
            "FOLDER/a.obj:5: warning: a face has fewer than three corners (2 in all) and is left out");
}

TEST_F(ReadObj, TextureCoordinates) {
  const ObjFile obj = read(with_four_vertices(
      "vt 0.25 0.5 0\nvt .75\nvt nan 0\nvt a b\nf 1/1 2/-3 3/2/\nf 1/1/ 2// 3\nf 1/3 2/3 3/4\n"));
  ASSERT_EQ(obj.texcoords.size(), 4u);
  EXPECT_EQ(obj.texcoords[0], Vec2(0.25f, 0.5f));
  EXPECT_EQ(obj.texcoords[1], Vec2(0.75f, 0));
  EXPECT_TRUE(std::isnan(obj.texcoords[2].x) && std::isnan(obj.texcoords[3].x));
  EXPECT_EQ(obj.triangles[0].texcoord, (Indices{0, 1, 1}));
  EXPECT_EQ(obj.triangles[1].texcoord, (Indices{0, kNoIndex, kNoIndex}));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(
      warning(0),
      "FOLDER/a.obj:7: warning: a texture coordinate is no finite number (2 in all); triangles that use "
      "one have no texture");
}

TEST_F(ReadObj, NumbersBeyondFloat) {
  const ObjFile obj = read("v 1e-999 -1e-60 1e-42\nv 0 1e300 0\nv 0 -1e999 0\n");
  EXPECT_EQ(obj.vertices[0].x, 0.0f);
  EXPECT_EQ(obj.vertices[0].y, 0.0f);
  EXPECT_EQ(obj.vertices[0].z, 1e-42f) << "subnormal, and still a number";
  EXPECT_TRUE(std::isnan(obj.vertices[1].y) && std::isnan(obj.vertices[2].y));
}

TEST_F(ReadObj, MoreTrianglesThanTheMachineHoldsAreRefused) {
  const std::filesystem::path file = folder_.write("a.obj", with_four_vertices("f 1 2 3\nf 1 2 3 4\n"));
  EXPECT_EQ(read_obj(file, warnings_, {.bytes = 100, .triangles = 3}).triangles.size(), 3u);
  const auto refusal = [&](const ObjLimits& limits) {
    return folder_.error_of([&] { (void)read_obj(file, warnings_, limits); });
  };
  EXPECT_EQ(refusal({.bytes = 100, .triangles = 2}),
            "FOLDER/a.obj:6: error: the file has more than 2 triangles, the most that are read here\n"
            "  hint: divide it, or use a machine with more memory");
  EXPECT_EQ(refusal({.bytes = 10, .triangles = 3}),
            "FOLDER/a.obj: error: the file has 0.0 MB; at most 0.0 MB are read\n"
            "  hint: check that it is the right file, or divide it");
}

TEST_F(ReadObj, TruncatedAndBinaryFiles) {
  EXPECT_EQ(read(with_four_vertices("f 1 2 3\nf 1 2")).triangles.size(), 1u);
  EXPECT_EQ(
      error_of("v 0 0 0\nv 1 0"),
      "FOLDER/a.obj:2: error: \"v 1 0\" is not \"v\" and three numbers\n  hint: for example v 0.5 1 -2e-3");
  EXPECT_EQ(error_of(std::string_view("\x89PNG\r\n\x1a\n\0\0", 10)),
            "FOLDER/a.obj:3: error: the file holds zero bytes: it is no text in UTF-8\n"
            "  hint: save it as UTF-8, without compression");
}

TEST_F(ReadObj, IndexOutOfRange) {
  constexpr std::string_view kHint =
      "\n  hint: indices count from 1; negative ones count back from the last one "
      "defined, -1";
  EXPECT_EQ(
      error_of(with_four_vertices("\nf 1 2 5\n")),
      std::string("FOLDER/a.obj:6: error: a face uses vertex 5, but 4 are defined before it").append(kHint));
  EXPECT_EQ(
      error_of(with_four_vertices("f 1 2 -5\n")),
      std::string("FOLDER/a.obj:5: error: a face uses vertex -5, but 4 are defined before it").append(kHint));
  EXPECT_EQ(error_of("f -2147483648 1 1\n"),
            std::string("FOLDER/a.obj:1: error: a face uses vertex -2147483648, but 0 are defined before it")
                .append(kHint));
}

TEST_F(ReadObj, NormalsThatAreNotDefinedAreDoneWithout) {
  const ObjFile obj = read(with_four_vertices("vn 0 0 1\nf 1//1 2//-1 3//2\nf 1//-2 2 3\n"));
  EXPECT_EQ(obj.triangles[0].normal, (Indices{0, 0, kNoIndex}));
  EXPECT_EQ(obj.triangles[1].normal, (Indices{kNoIndex, kNoIndex, kNoIndex}));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(
      warning(0),
      "FOLDER/a.obj:6: warning: a face uses a normal that is not defined before it (2 in all); the corner "
      "has the normal of its triangle");
}

TEST_F(ReadObj, WhatIsNoIndex) {
  constexpr std::string_view kHint =
      "\n  hint: corners are written 1, 1/2, 1//3 or 1/2/3; no index is 0; -1 is the last "
      "vertex so far";
  for (const std::string face : {"f 0 1 2", "f 1 2 3/0", "f 1//0 2 3", "f 1 two 3", "f 1.5 2 3",
                                 "f 1 2 4294967297", "f 1-2 3 4", "f +1 2 3", "f /1 2 3", "f 1/2/3/4 2 3"}) {
    EXPECT_EQ(error_of(with_four_vertices("# remark\n" + face)),
              ("FOLDER/a.obj:6: error: \"" + face + "\" is no face").append(kHint));
  }
}

TEST_F(ReadObj, WhatIsNoVertex) {
  for (const std::string line :
       {"v 1 2", "v 1 2 x", "v 1 2 -", "v , 2 3", "v 0x1 2 3", "v 1.2.3 0 0", "v 1-2 0 0"}) {
    EXPECT_EQ(error_of("\n" + line + "\n"),
              "FOLDER/a.obj:2: error: \"" + line +
                  "\" is not \"v\" and three numbers\n  hint: for example v 0.5 1 -2e-3");
  }
  EXPECT_EQ(error_of("vn 0 1\n"),
            "FOLDER/a.obj:1: error: \"vn 0 1\" is not \"vn\" and three numbers\n  hint: for example vn 0.5 1 "
            "-2e-3");
}

}  // namespace
}  // namespace lemma
