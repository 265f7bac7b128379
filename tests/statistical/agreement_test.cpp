#include <gtest/gtest.h>

#include <vector>

#include "tests/support/agreement.h"
#include "tests/support/images.h"
#include "tests/support/light_scenes.h"

namespace lemma {
namespace {

using test::expect_agreement;

constexpr int kScenes = 9;
constexpr int kEdge = 4;  // [pixels]: few, so that each has many samples, which stratify it

Scene small_scene(std::string_view name, const Vec3& eye, const Vec3& look_at, float fovy) {
  Scene scene = test::own_scene(name, kEdge, kEdge);
  scene.view.eye = eye;
  scene.view.look_at = look_at;
  scene.view.fovy = fovy;
  return scene;
}

Scene smaller(Scene scene, float fovy) {
  scene.view.fovy = fovy;
  scene.view.width = scene.view.height = kEdge;
  return scene;
}

/// From below the ceiling on the top of the tall block, from which the light looks larger than from elsewhere
/// (BRDF samples alone find it seldom enough), and on its side, which has indirect light above all. Errors of
/// indirect light alone are diluted here; the glossy rooms have more of it.
Scene cornell(std::string_view name) {
  return small_scene(name, {278, 480, -150}, {290, 330, 300}, 3);
}

/// On the plate of exponent 500, inside the reflection of a light, and on its front. Elsewhere solid-angle
/// and projected, at 10 us a sample, need ten times as many samples for the same bias.
TEST(Agreement, VeachScene) {
  Scene scene = test::own_scene("veach-mis", kEdge, kEdge);
  scene.view.look_at = {5, 1.5f, -3.5f};
  scene.view.fovy = 2;
  expect_agreement({.scene = scene}, kScenes);
}

TEST(Agreement, CornellBox) {
  expect_agreement({.scene = cornell("cornell-box")}, kScenes);
}

TEST(Agreement, CornellBoxWithTheLightInTheCeiling) {
  expect_agreement({.scene = cornell("cornell-coplanar")}, kScenes);
}

TEST(Agreement, ManyLights) {
  expect_agreement({.scene = smaller(test::many_lights(), 15)}, kScenes);
}

TEST(Agreement, OverlappingLights) {
  expect_agreement({.scene = smaller(test::overlapping_lights(), 10)}, kScenes);
}

/// The floor and the block alone: the light itself would be most of the mean.
TEST(Agreement, LightPartlyBelowTheHorizon) {
  Scene scene = smaller(test::light_below_horizon(), 15);
  scene.view.look_at = {0, 0, 0.3f};
  expect_agreement({.scene = scene, .touches_light = true}, kScenes);
}

/// A light that lies twice in one place: seen once, whatever finds it (src/scene/overlays.h).
TEST(Agreement, LightsOnTopOfEachOther) {
  Scene scene = cornell("cornell-coplanar");
  test::double_lights(scene);
  expect_agreement({.scene = scene}, kScenes);
}

/// What no other scene of the family has: light that cannot leave, wide lobes that the horizon cuts beside
/// sharp ones. The floor, a ball on it and the walls; no light is seen.
Scene room(Lobe lobe) {
  Scene scene = smaller(test::glossy_room({.lobe = lobe}), 25);
  scene.view.look_at = {0.2f, -0.8f, 0};
  return scene;
}

TEST(Agreement, GlossyRoomOfPhong) {
  expect_agreement({.scene = room(Lobe::phong), .touches_light = true}, kScenes);
}

TEST(Agreement, GlossyRoomOfBlinnPhong) {
  expect_agreement({.scene = room(Lobe::blinn_phong), .touches_light = true}, kScenes);
}

}  // namespace
}  // namespace lemma
