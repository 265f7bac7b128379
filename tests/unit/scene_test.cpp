#include <gtest/gtest.h>

#include <numbers>

#include "src/core/warp.h"
#include "src/scene/load_scene.h"
#include "src/scene/scene_error.h"
#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

constexpr std::string_view kCamera = R"(<camera width="64" height="48" fovy="40"> <eye x="0" y="0" z="5"/>
<lookat x="0" y="0" z="0"/> <up x="0" y="1" z="0"/> </camera>
)";
constexpr std::string_view kLight = "<light mtlname=\"lamp\" radiance=\"17,12,4\"/>\n";
constexpr std::string_view kMtl = "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0.25 0.25 0.25\n";

/// A square of two triangles in the plane z = 0, its normal along z.
constexpr std::string_view kVertices = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
constexpr std::string_view kObj =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl wall\nf 1 2 3 4\nusemtl lamp\nf 1 2 3\n";

class LoadScene : public testing::Test {
 protected:
  LoadedScene load(std::string_view xml, std::string_view obj, std::string_view mtl) {
    folder_.write("a.xml", xml);
    folder_.write("a.obj", obj);
    folder_.write("a.mtl", mtl);
    LoadedScene loaded = load_scene(folder_.path(), options_);
    for (std::string& warning : loaded.report.warnings) warning = folder_.plain(warning);
    return loaded;
  }

  LoadedScene load_obj(std::string_view faces) {
    return load(lit(), std::string(kVertices).append(faces), kMtl);
  }
  LoadedScene load_mtl(std::string_view mtl) { return load(lit(), kObj, mtl); }

  /// Camera and light.
  static std::string lit() { return std::string(kCamera).append(kLight); }

  test::SceneFolder folder_;
  LoadOptions options_;
};

using Lines = std::vector<std::string>;

TEST_F(LoadScene, PutsTheFilesTogether) {
  const auto [scene, report] = load(lit(), kObj, kMtl);
  EXPECT_EQ(scene.view.width, 64);
  EXPECT_EQ(report.mtl, std::vector<std::filesystem::path>{folder_.path() / "a.mtl"});
  EXPECT_TRUE(report.warnings.empty());
  ASSERT_EQ(scene.triangles.size(), 3u);
  EXPECT_EQ(scene.triangles[1].v1, Vec3(1, 1, 0));
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[1].kd, (Rgb{0.25f, 0.25f, 0.25f})) << "lights keep what they could reflect";
  EXPECT_EQ(scene.facets[0].material, 0u);
  EXPECT_EQ(scene.facets[0].emitter, kNoEmitter);
  EXPECT_EQ(scene.facets[2].material, 1u);
  EXPECT_EQ(scene.facets[2].emitter, 0u);
  ASSERT_EQ(scene.emitters.size(), 1u);
  EXPECT_EQ(scene.emitters[0].triangle, 2u);
  EXPECT_EQ(scene.emitters[0].radiance, (Rgb{17, 12, 4}));
}

TEST_F(LoadScene, DescribesItself) {
  const LoadedScene flat = load(lit(), kObj, kMtl);
  EXPECT_EQ(
      describe(flat),
      "a.xml + a.obj + a.mtl: 3 triangles (0 dropped), 2 materials, 1 light with 1 triangle, camera 64x48");
  EXPECT_EQ(describe(flat.scene.needs), "Lambert, opaque, no textures, flat normals, 1 light (1 triangle)");
  const SceneNeeds all{
      .model = {.specular = true, .smooth_normals = true}, .lights = 4, .emitter_triangles = 3040};
  EXPECT_EQ(describe(all), "Lambert + Phong, opaque, no textures, smooth normals, 4 lights (3040 triangles)");
}

TEST_F(LoadScene, NormOfThePhongLobe) {
  load_mtl("newmtl wall\nKs 1 1 1\nNs 7\nnewmtl lamp\n");
  const LoadedScene one = load_scene(folder_.path());
  const LoadedScene two = load_scene(folder_.path(), {.brdf = {.norm = PhongNorm::n_plus_2}});
  EXPECT_FLOAT_EQ(one.scene.materials[0].specular_factor, 8 / (2 * kPi));
  EXPECT_FLOAT_EQ(two.scene.materials[0].specular_factor, 9 / (2 * kPi));
}

TEST_F(LoadScene, DegenerateTrianglesAreDroppedAndCounted) {
  const auto [scene, report] = load_obj(
      "v nan 0 0\nv 2e18 0 0\nv 2 2 0\nusemtl wall\nf 1 1 2\nf 1 3 7\nf 1 2 5\nf 1 6 2\nf 2 3 4\nusemtl "
      "lamp\nf 1 2 3\n");
  EXPECT_EQ(report.triangles_read, 6u);
  EXPECT_EQ(report.dropped_zero_area, 2u) << "a repeated corner, three corners in line";
  EXPECT_EQ(report.dropped_non_finite, 2u);
  ASSERT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.facets.size(), 2u);
  ASSERT_EQ(scene.emitters.size(), 1u);
  EXPECT_EQ(scene.emitters[0].triangle, 1u) << "counts without the dropped ones";
  EXPECT_NE(describe({scene, report}).find("6 triangles (4 dropped: 2 of zero area, 2 not finite)"),
            std::string::npos);
}

TEST_F(LoadScene, SmallAndLargeTrianglesAreKept) {
  const auto [scene, report] =
      load_obj("v 1e-30 0 0\nv 0 1e-30 0\nv 1e18 0 0\nv 0 1e18 0\nusemtl lamp\nf 1 5 6\nf 1 7 8\n");
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(geometric_normal(scene.emitters[0].shape), Vec3(0, 0, 1));
  EXPECT_EQ(geometric_normal(scene.emitters[1].shape), Vec3(0, 0, 1));
}

TEST_F(LoadScene, EmittersFaceTheirVertexNormals) {
  const auto emitter_normal = [&](std::string_view face) {
    const Scene scene =
        load_obj(std::string("vn 0 0 1\nvn 0 0 -3\nvn 0 0 0\nusemtl lamp\n").append(face)).scene;
    EXPECT_EQ(scene.triangles[0].v1, Vec3(1, 0, 0)) << "triangles keep the winding of the file";
    EXPECT_EQ(scene.triangles[0].v2, Vec3(1, 1, 0));
    return geometric_normal(scene.emitters[0].shape).z;
  };
  EXPECT_EQ(emitter_normal("f 1 2 3\n"), 1) << "no normals: the winding";
  EXPECT_EQ(emitter_normal("f 1//1 2//1 3//1\n"), 1);
  EXPECT_EQ(emitter_normal("f 1//2 2//2 3//2\n"), -1);
  EXPECT_EQ(emitter_normal("f 1//2 2//2 3//1\n"), -1) << "the mean of unit normals";
  EXPECT_EQ(emitter_normal("f 1//1 2//2 3//2\n"), -1) << "not the first one";
  EXPECT_EQ(emitter_normal("f 1//1 2//1 3//2\n"), 1) << "long ones weigh no more";
  EXPECT_EQ(emitter_normal("f 1//3 2//3 3//3\n"), 1) << "zero normals say nothing";
}

TEST_F(LoadScene, SpecularOnlyIfSomethingReflectsSo) {
  constexpr std::string_view kShinyLamp =
      "newmtl wall\nKd 1 1 1\nnewmtl lamp\nKs 1 1 1\nnewmtl unused\nKs 1 1 1\n";
  EXPECT_FALSE(load_mtl(kShinyLamp).scene.needs.model.specular);
  EXPECT_TRUE(load_mtl("newmtl wall\nKs 0 0 1e-6\nnewmtl lamp\n").scene.needs.model.specular);
}

TEST_F(LoadScene, NormalsAreStoredOnlyIfTheyDiffer) {
  const auto load_normals = [&](std::string_view normals, std::string_view material) {
    return load_obj(std::string(normals).append("usemtl ").append(material).append("\nf 1//1 2//2 3//3\n") +
                    "usemtl lamp\nf 1 2 3\n")
        .scene;
  };
  constexpr std::string_view kFlat = "vn 0 0 2\nvn 0.00019 0 1\nvn 0 0 0\n",
                             kBehind = "vn 0 0 -1\nvn 0 0 -1\nvn 0 0 1\n",
                             kRound = "vn 0 0 2\nvn 0.00021 0 1\nvn 0 0 0\n";
  EXPECT_TRUE(load_normals(kFlat, "wall").normals.empty()) << "six printed digits";
  EXPECT_TRUE(load_normals(kBehind, "wall").normals.empty()) << "the side does not matter";
  EXPECT_TRUE(load_normals(kRound, "lamp").normals.empty()) << "lights do not reflect";
  const Scene smooth = load_normals(kRound, "wall");
  EXPECT_TRUE(smooth.needs.model.smooth_normals);
  ASSERT_EQ(smooth.normals.size(), 2u) << "one set for each triangle, those without included";
  EXPECT_EQ(smooth.normals[0][0], Vec3(0, 0, 1)) << "unit length";
  EXPECT_NEAR(smooth.normals[0][1].x, 0.00021f, 1e-9f);
  EXPECT_EQ(smooth.normals[0][2], Vec3(0, 0, 1)) << "in place of a zero normal";
  EXPECT_EQ(smooth.normals[1][0], Vec3(0, 0, 1)) << "in place of none";
}

TEST_F(LoadScene, MissingNormalsTakeTheSideOfTheOthers) {
  const Scene scene =
      load_obj("vn 0.1 0 -1\nvn nan 0 1\nusemtl wall\nf 1//1 2//2 3\nusemtl lamp\nf 1 2 3\n").scene;
  ASSERT_EQ(scene.normals.size(), 2u);
  EXPECT_EQ(scene.normals[0][1], Vec3(0, 0, -1));
  EXPECT_EQ(scene.normals[0][2], Vec3(0, 0, -1));
}

TEST_F(LoadScene, LightsAreNumberedAsInTheXmlAndOnlyIfTheyHaveTriangles) {
  const auto [scene, report] =
      load(std::string(kCamera) +
               "<light mtlname=\"b\" radiance=\"2,2,2\"/>\n<light mtlname=\"none\" radiance=\"3,3,3\"/>\n"
               "<light mtlname=\"idle\" radiance=\"3,3,3\"/>\n<light mtlname=\"flat\" radiance=\"3,3,3\"/>\n"
               "<light mtlname=\"a\" radiance=\"1,1,1\"/>\n<light mtlname=\"A\" radiance=\"1,1,1\"/>\n",
           std::string(kVertices) + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3 4\nusemtl flat\nf 1 1 1\n",
           "newmtl a\nnewmtl b\nnewmtl idle\nnewmtl flat\n");
  ASSERT_EQ(scene.emitters.size(), 3u);
  EXPECT_EQ(scene.emitters[0].light, 1u);
  EXPECT_EQ(scene.emitters[0].radiance, (Rgb{1, 1, 1}));
  EXPECT_EQ(scene.emitters[1].light, 0u);
  EXPECT_EQ(scene.emitters[2].light, 0u);
  EXPECT_EQ(scene.needs.lights, 2u);
  EXPECT_EQ(scene.needs.emitter_triangles, 3u);
  EXPECT_EQ(report.warnings,
            (Lines{"FOLDER/a.xml:4:1: warning: light \"none\": there is no such material",
                   "FOLDER/a.xml:8:1: warning: light \"A\": there is no such material; is \"a\" meant?",
                   "FOLDER/a.xml:5:1: warning: light \"idle\" has no triangle",
                   "FOLDER/a.xml:6:1: warning: light \"flat\" has no triangle"}));
}

TEST_F(LoadScene, KeEmitsWhereTheXmlGivesNoLight) {
  const auto [scene, report] = load(kCamera, kObj, "newmtl wall\nnewmtl lamp\nKe 17 12 4\n");
  ASSERT_EQ(scene.emitters.size(), 1u);
  EXPECT_EQ(scene.emitters[0].radiance, (Rgb{17, 12, 4}));
  EXPECT_TRUE(report.warnings.empty());
}

TEST_F(LoadScene, KeIsNeverAddedToTheXml) {
  const auto [scene, report] = load_mtl("newmtl wall\nnewmtl lamp\nKe 1 2 3\n");
  EXPECT_EQ(scene.emitters[0].radiance, (Rgb{17, 12, 4}));
  EXPECT_EQ(report.warnings,
            Lines{"FOLDER/a.mtl:2: warning: Ke 1 2 3 of \"lamp\" is left out: the XML gives a radiance"});
}

TEST_F(LoadScene, KaEmitsOnlyByRuleAndWhereNothingElseSays) {
  constexpr std::string_view mtl =
      "newmtl wall\nKa 1 1 1\nKd 0.5 0.5 0.5\nnewmtl lamp\nKa 901.8 901.8 900\nKe 3 2 1\n";
  EXPECT_EQ(load(kCamera, kObj, mtl).scene.emitters[0].radiance, (Rgb{3, 2, 1})) << "Ke before Ka";
  options_.emission = EmissionRule::ka;
  EXPECT_EQ(load(kCamera, kObj, mtl).scene.emitters[0].radiance, (Rgb{3, 2, 1}));
  const auto by_ka = load(kCamera, kObj, "newmtl wall\nKa 1 1 1\nnewmtl lamp\nKa 901.8 901.8 900\n");
  ASSERT_EQ(by_ka.scene.emitters.size(), 1u);
  EXPECT_EQ(by_ka.scene.emitters[0].radiance, (Rgb{901.8f, 901.8f, 900}));
  EXPECT_EQ(by_ka.report.warnings,
            Lines{"FOLDER/a.mtl:3: warning: \"lamp\" emits 901.8 901.8 900 by its Ka"});
  EXPECT_EQ(load(lit(), kObj, "newmtl wall\nnewmtl lamp\nKa 9 9 9\n").scene.emitters[0].radiance,
            (Rgb{17, 12, 4}))
      << "the XML before all";
}

TEST_F(LoadScene, NamesEmitOnlyByRule) {
  const std::string obj = std::string(kVertices) + "usemtl wall\nf 1 2 3 4\nusemtl CeilingLight\nf 1 2 3\n";
  options_.emission = EmissionRule::name;
  const auto [scene, report] = load(kCamera, obj, "newmtl wall\nnewmtl CeilingLight\nKd 1 1 1\n");
  ASSERT_EQ(scene.emitters.size(), 1u);
  EXPECT_EQ(scene.emitters[0].radiance, (Rgb{1, 1, 1}));
  EXPECT_EQ(report.warnings, Lines{"FOLDER/a.mtl:2: warning: \"CeilingLight\" emits 1 1 1 by its name"});
}

TEST_F(LoadScene, SpheresBecomeTrianglesOfTheSameArea) {
  const auto [scene, report] =
      load(lit() + R"(<sphere mtlname="lamp" center="1, 2, 3" radius="0.5"/>)", kObj, kMtl);
  ASSERT_EQ(scene.emitters.size(), 1u + 1280u);
  double sum = 0;
  for (std::size_t i = 1; i < scene.emitters.size(); ++i) {
    const Emitter& e = scene.emitters[i];
    sum += area(e.shape);
    EXPECT_FALSE(emits_towards(e, {1, 2, 3})) << "outwards";
    EXPECT_NEAR(length(Vec3d(e.shape.v0) - Vec3d(1, 2, 3)), 0.5, 0.005)
        << "1280 triangles bulge by less than 1 %";
  }
  // Each of 1280 areas has the rounding of its vertices, 2^-24 * 3.5, on edges of about 0.07.
  EXPECT_NEAR(sum, std::numbers::pi, std::numbers::pi * 0x1p-24 * 3.5 / 0.07 * 2);
  EXPECT_EQ(scene.needs.lights, 1u);
  EXPECT_TRUE(report.warnings.empty());
}

TEST_F(LoadScene, BlackLightsReflect) {
  const auto [scene, report] = load(lit() + "<light mtlname=\"wall\" radiance=\"0,0,0\"/>", kObj,
                                    "newmtl wall\nKe 1 1 1\nnewmtl lamp\n");
  EXPECT_EQ(scene.facets[0].emitter, kNoEmitter);
  EXPECT_EQ(report.warnings,
            (Lines{"FOLDER/a.mtl:1: warning: Ke 1 1 1 of \"wall\" is left out: the XML gives a radiance",
                   "FOLDER/a.xml:4:1: warning: light \"wall\" has radiance 0 and reflects instead"}));
}

TEST_F(LoadScene, UndefinedMaterialsAreGrey) {
  const auto [scene, report] = load_obj("f 1 2 3\nusemtl odd\nf 1 2 3\nusemtl lamp\nf 1 2 3\n");
  ASSERT_EQ(scene.materials.size(), 4u);
  EXPECT_EQ(scene.materials[2].kd, (Rgb{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(scene.facets[0].material, 2u);
  EXPECT_EQ(scene.facets[1].material, 3u);
  EXPECT_EQ(report.warnings,
            Lines{"FOLDER/a.obj:6: warning: no material is defined for faces without usemtl, odd; Kd "
                  "0.5 is used"});
}

TEST_F(LoadScene, LightsNeedNoMtl) {
  folder_.write("a.xml", lit());
  folder_.write("a.obj", kObj);
  const auto [scene, report] = load_scene(folder_.path() / "a.obj");
  EXPECT_EQ(scene.emitters.size(), 1u);
  ASSERT_EQ(report.warnings.size(), 2u);
  EXPECT_EQ(folder_.plain(report.warnings[0]), "FOLDER/a.obj:1: warning: there is no \"a.mtl\"");
  EXPECT_EQ(folder_.plain(report.warnings[1]),
            "FOLDER/a.obj:6: warning: no material is defined for wall, lamp; Kd 0.5 is used");
}

TEST_F(LoadScene, TransmittanceOfTheCourseIsNotDissolve) {
  const auto [scene, report] =
      load_mtl("newmtl wall\nKd 0.5 0.5 0.5\nTr 1 1 1\nNi 1\nnewmtl lamp\nTr 1 1 1\n");
  EXPECT_EQ(scene.materials[0].kd, (Rgb{0.5f, 0.5f, 0.5f}));
  EXPECT_FALSE(scene.needs.model.glass);
  EXPECT_TRUE(scene.glass.empty());
  EXPECT_TRUE(report.warnings.empty());
}

TEST_F(LoadScene, GlassNeedsAnIndexAndNothingThatSaysOpaque) {
  const auto glass = [&](const std::string& lines) {
    const Scene scene = load_mtl("newmtl wall\n" + lines + "\nnewmtl lamp\n").scene;
    return scene.needs.model.glass ? scene.glass[0] : Dielectric{};
  };
  const auto expect_glass = [&](const std::string& lines, const Rgb& transmittance) {
    EXPECT_EQ(glass(lines).ior, 1.5f) << lines;
    EXPECT_EQ(glass(lines).transmittance, transmittance) << lines;
  };
  expect_glass("Ni 1.5\nTr 0.8 1 0.95", {0.8f, 1, 0.95f});
  expect_glass("Ni 1.5\nTr 0.8 1 0.95\nd 1\nillum 2", {0.8f, 1, 0.95f});
  expect_glass("Ni 1.5\nTr 0.75", {0.75f, 0.75f, 0.75f});
  expect_glass("Ni 1.5\nd 0.25", {0.75f, 0.75f, 0.75f});
  expect_glass("Ni 1.5", {1, 1, 1});
  expect_glass("Ni 1.5\nillum 7", {1, 1, 1});
  for (const char* opaque : {"Ni 1", "Tr 0.8 1 0.95", "Ni 1\nTr 0.5", "Ni 0.9\nTr 1 1 1", "Ni 1.5\nd 1",
                             "Ni 1.5\nTr 0", "Ni 1.5\nTr 0 0 0", "Ni 1.5\nillum 2", "Ni 1.5\nTr 0\nd 0.5"}) {
    EXPECT_EQ(glass(opaque).ior, 1.0f) << opaque;
  }
}

TEST_F(LoadScene, GlassIsInsideOutWhereTheWindingOpposesTheNormals) {
  const Scene scene = load(lit(),
                           std::string(kVertices) +
                               "vn 0 0 1\nvn 0 0 -1\nusemtl glass\nf 1//1 2//1 3//1\n"
                               "f 1//2 2//2 3//2\nf 1 2 3\nusemtl lamp\nf 1 2 3\n",
                           "newmtl glass\nNi 2\nnewmtl lamp\n")
                          .scene;
  const auto ior = [&](std::size_t triangle) { return scene.glass[scene.facets[triangle].material].ior; };
  EXPECT_EQ(ior(0), 2.0f);
  EXPECT_EQ(ior(1), 0.5f);
  EXPECT_EQ(ior(2), 2.0f) << "no normals: the winding";
  EXPECT_EQ(scene.materials.size(), 3u);
}

constexpr std::string_view kFourMaterials =
    "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl lamp\nf 1 2 3\n";

TEST_F(LoadScene, BrightMaterialsAreWarnedOfOnce) {
  const auto [scene, report] = load(lit(), std::string(kVertices).append(kFourMaterials),
                                    "newmtl a\nKd 0.8 0 0\nKs 0.2 0 0\nnewmtl b\nKd 0.8 0 0\nKs 0.3 0 "
                                    "0\nnewmtl c\nKd 2 0 0\nnewmtl lamp\nKd 9 9 9\n");
  EXPECT_EQ(scene.materials[2].kd, (Rgb{2, 0, 0})) << "used as it is";
  EXPECT_EQ(report.warnings,
            Lines{"FOLDER/a.mtl:4: warning: Kd + Ks > 1: more light leaves than arrives, of b, c"});
}

/// One pixel each: red is (255, 0, 0).
constexpr std::string_view kRed = "P3\n1 1\n255\n255 0 0\n";
const std::string kTextured =
    std::string(kVertices) +
    "vt 0 0\nvt 1 0\nvt 1 1\nusemtl wall\nf 1/1 2/2 3/3\nusemtl lamp\nf 1/1 2/2 3/3\n";

TEST_F(LoadScene, TexturesReplaceKdOrAreMultipliedWithIt) {
  folder_.write("red.ppm", kRed);
  constexpr std::string_view mtl =
      "newmtl wall\nKd 0.5 0.25 0.5\nmap_Kd red.ppm\nnewmtl lamp\nmap_Kd none.ppm\n";
  const auto replaced = load(lit(), kTextured, mtl);
  EXPECT_TRUE(replaced.report.warnings.empty()) << "a light shows no texture";
  ASSERT_EQ(replaced.scene.textures.size(), 1u);
  EXPECT_EQ(replaced.scene.texture_of[0].texture, 0u);
  EXPECT_EQ(replaced.scene.texture_of[0].tint, (Rgb{1, 1, 1}));
  EXPECT_EQ(replaced.scene.texture_of[1].texture, kNoTexture);
  EXPECT_EQ(replaced.scene.texcoords[0][1], Vec2(1, 0));
  EXPECT_EQ(describe(replaced.scene.needs),
            "Lambert, opaque, 1 texture in place of Kd, flat normals, 1 light (1 triangle)");
  options_.textures = TextureRule::multiply;
  const auto multiplied = load(lit(), kTextured, mtl);
  EXPECT_EQ(multiplied.scene.texture_of[0].tint, (Rgb{0.5f, 0.25f, 0.5f}));
  EXPECT_EQ(describe(multiplied.scene.needs),
            "Lambert, opaque, 1 texture times Kd, flat normals, 1 light (1 triangle)");
}

TEST_F(LoadScene, OneImageIsReadOnce) {
  folder_.write("images/Red.PPM", kRed);
  const auto [scene, report] =
      load(lit(),
           std::string(kVertices) +
               "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\nusemtl lamp\nf 1 2 3\n",
           "newmtl a\nmap_Kd images/Red.PPM\nnewmtl b\nmap_Kd .\\images\\red.ppm\nnewmtl lamp\n");
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(report.warnings,
            Lines{"FOLDER/a.mtl:4: warning: there is no \".\\images\\red.ppm\"; Red.PPM is used"});
}

TEST_F(LoadScene, MissingAndBrokenTexturesLeaveKd) {
  folder_.write("broken.ppm", "no image");
  const auto [scene, report] =
      load(lit(),
           std::string(kVertices) +
               "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\nusemtl lamp\nf 1 2 3\n",
           "newmtl a\nKd 0.1 0.1 0.1\nmap_Kd x.jpg\nnewmtl b\nKd 0 0 0\nmap_Kd broken.ppm\nnewmtl lamp\n");
  EXPECT_FALSE(scene.needs.model.textures);
  EXPECT_TRUE(scene.texcoords.empty());
  EXPECT_EQ(scene.materials[0].kd, (Rgb{0.1f, 0.1f, 0.1f}));
  EXPECT_EQ(scene.materials[1].kd, (Rgb{0.5f, 0.5f, 0.5f}));
  ASSERT_EQ(report.warnings.size(), 2u);
  EXPECT_EQ(report.warnings[0],
            "FOLDER/a.mtl:3: warning: there is no texture \"x.jpg\"; Kd stands in its place");
  EXPECT_TRUE(
      report.warnings[1].starts_with("FOLDER/a.mtl:6: warning: the texture \"broken.ppm\" cannot be read: "));
  EXPECT_TRUE(report.warnings[1].ends_with("; grey 0.5 stands in its place"));
}

TEST_F(LoadScene, TrianglesWithoutTextureCoordinatesHaveNoTexture) {
  folder_.write("red.ppm", kRed);
  const auto [scene, report] =
      load(lit(),
           std::string(kVertices) +
               "vt 0 0\nvt nan 0\nusemtl wall\nf 1/1 2/1 3/1\nf 1 2 3\nf 1/1 2/2 3/1\nusemtl lamp\nf 1 2 3\n",
           "newmtl wall\nmap_Kd red.ppm\nnewmtl lamp\n");
  const auto texture = [&](std::size_t t) { return scene.texture_of[scene.facets[t].material].texture; };
  EXPECT_EQ(texture(0), 0u);
  EXPECT_EQ(texture(1), kNoTexture);
  EXPECT_EQ(texture(2), kNoTexture);
  EXPECT_EQ(scene.materials[scene.facets[1].material].kd, (Rgb{0.5f, 0.5f, 0.5f}));
  ASSERT_EQ(report.warnings.size(), 2u);
  EXPECT_EQ(report.warnings[1],
            "FOLDER/a.obj: warning: 2 triangles with a texture have no texture coordinates; Kd stands in its "
            "place, or "
            "grey 0.5");
}

TEST_F(LoadScene, NoEmitters) {
  const auto error = [&](std::string_view xml, std::string_view mtl) {
    return folder_.error_of([&] { (void)load(xml, kObj, mtl); });
  };
  EXPECT_EQ(error(kCamera, "newmtl wall\nKd 1 1 1\nnewmtl lamp\nKd 1 1 1\n"),
            "FOLDER/a.xml: error: no emitters found: the image would be black\n"
            "  hint: write <light mtlname=\"NAME\" radiance=\"17, 12, 4\"/> into the XML, with the name of a "
            "material");
  EXPECT_EQ(error(kCamera, "newmtl wall\nKa 0.2 0.2 0.2\nnewmtl lamp\nKa 20 20 10\n"),
            "FOLDER/a.xml: error: no emitters found: the image would be black\n"
            "  hint: candidates: \"lamp\" (Ka 20 20 10); write <light mtlname=\"NAME\" radiance=\"17, 12, "
            "4\"/> into the XML, or let --emission ka take what looks like a light");
}

TEST_F(LoadScene, CandidatesByName) {
  EXPECT_EQ(folder_.error_of([&] {
    (void)load(kCamera, std::string(kVertices) + "usemtl CeilingLight\nf 1 2 3\n",
               "newmtl CeilingLight\nnewmtl LIGHT\n");
  }),
            "FOLDER/a.xml: error: no emitters found: the image would be black\n"
            "  hint: candidates: \"CeilingLight\" (Ka 0 0 0); write <light mtlname=\"NAME\" radiance=\"17, "
            "12, 4\"/> into "
            "the XML, or let --emission name take what looks like a light");
}

TEST_F(LoadScene, NoTriangles) {
  const auto error = [&](std::string_view obj) {
    return folder_.error_of([&] { (void)load(lit(), obj, kMtl); });
  };
  const std::string hint = "\n  hint: the faces need three corners that are not in line";
  EXPECT_EQ(error(kVertices), "FOLDER/a.obj: error: no triangle can be rendered, of 0 read" + hint);
  EXPECT_EQ(error(std::string(kVertices) + "f 1 1 1\n"),
            "FOLDER/a.obj: error: no triangle can be rendered, of 1 read" + hint);
}

}  // namespace
}  // namespace lemma
