// Scenes of the course, which carry no licence and so are no part of the project.

#include <gtest/gtest.h>

#include "src/core/bounds.h"
#include "src/scene/load_scene.h"
#include "src/scene/scene_error.h"
#include "tests/support/real_scenes.h"

namespace lemma {
namespace {

class RealScenes : public testing::Test {
 protected:
  void SetUp() override {
    const auto folder = test::real_scenes();
    if (!folder) GTEST_SKIP() << test::kNoRealScenes;
    folder_ = *folder;
  }

  LoadedScene load(const std::string& name) const {
    if (!std::filesystem::exists(folder_ / name)) ADD_FAILURE() << "there is no " << folder_ / name;
    LoadedScene loaded = load_scene(folder_ / name);
    for (std::string& warning : loaded.report.warnings)
      warning.erase(0, (folder_ / name / "").string().size());
    return loaded;
  }

  std::filesystem::path folder_;
};

using Lines = std::vector<std::string>;

TEST_F(RealScenes, VeachMis2023) {
  const LoadedScene loaded = load("zju-2023-veach-mis");
  EXPECT_EQ(describe(loaded),
            "veach-mis.xml + veach-mis.obj + veach-mis.mtl: 3092 triangles (0 dropped), 10 materials, 4 "
            "lights with 3040 triangles, camera 1280x720");
  EXPECT_EQ(describe(loaded.scene.needs),
            "Lambert + Phong, opaque, no textures, flat normals, 4 lights (3040 triangles)");
  EXPECT_EQ(loaded.report.warnings, Lines{});
}

TEST_F(RealScenes, CornellBox2021) {
  const LoadedScene loaded = load("zju-2021-cornell-box");
  EXPECT_EQ(describe(loaded),
            "cornell-box.xml + cornell-box.obj + cornell-box.mtl: 15056 triangles (0 dropped), 7 "
            "materials, 1 light with 2 triangles, camera 1024x1024");
  EXPECT_EQ(describe(loaded.scene.needs),
            "Lambert, opaque, 1 texture in place of Kd, smooth normals, 1 light (2 triangles)");
  EXPECT_EQ(loaded.report.warnings, Lines{});
}

TEST_F(RealScenes, Staircase2022) {
  const LoadedScene loaded = load("zju-2022-staircase");
  EXPECT_EQ(describe(loaded),
            "staircase.xml + staircase.obj + stairscase.mtl: 31407 triangles (2432 dropped: 2432 of zero "
            "area, 0 not finite), 14 materials, 6 lights with 496 triangles, camera 1280x720");
  EXPECT_EQ(describe(loaded.scene.needs),
            "Lambert + Phong, glass, 3 textures in place of Kd, smooth normals, 6 lights (496 triangles)");
  EXPECT_EQ(loaded.scene.triangles.size(), 31407u - 2432u);
  EXPECT_EQ(loaded.report.warnings,
            (Lines{"staircase.xml:19:1: warning: <render> is unknown and left out",
                   "stairscase.mtl:82: warning: Kd + Ks > 1: more light leaves than arrives, of Chrome"}));
}

TEST_F(RealScenes, LightsFaceTheRoom) {
  const LoadedScene cornell = load("zju-2021-cornell-box");
  for (const Emitter& e : cornell.scene.emitters) EXPECT_TRUE(emits_towards(e, {0, 1, 0}));
}

TEST_F(RealScenes, SpheresEmitOutwards) {
  const LoadedScene veach = load("zju-2023-veach-mis");
  std::vector<Bounds> lights(4);
  for (const Emitter& e : veach.scene.emitters) lights.at(e.light).add(e.shape);
  std::size_t inwards = 0;
  for (const Emitter& e : veach.scene.emitters) {
    const Bounds& light = lights[e.light];
    inwards += emits_towards(e, (light.lo + light.hi) * 0.5f);
  }
  EXPECT_EQ(inwards, 0u);
}

TEST_F(RealScenes, McGuireHasNoCamera) {
  try {
    (void)load("mcguire-cornell-original");
    FAIL() << "loaded";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("there is no XML file with camera and lights"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace lemma
