// Glass in whole scenes, where what must come out is known exactly.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

/// Emission 1 from all around, and in the middle a closed body of glass.
/// @param ior  of the body, over that around it; its reciprocal turns the body inside out
Scene glass_in_uniform_light(const std::vector<Triangle>& body, float ior) {
  Scene scene;
  scene.view = {{0.2f, 0.3f, 1.9f}, {0.1f, 0.1f, 0}, {0, 1, 0}, 70, 24, 24};
  scene.triangles = test::inward_box({-2, -2, -2}, {2, 2, 2});
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    scene.facets.push_back({0, i});
    scene.emitters.push_back({scene.triangles[i], {1, 1, 1}, i, 0});
  }
  for (const Triangle& t : body) {
    scene.triangles.push_back(t);
    scene.facets.push_back({1, kNoEmitter});
  }
  scene.materials = {make_material({}, {}, 1), make_material({0.5f, 0.5f, 0.5f}, {}, 1)};
  scene.glass = {Dielectric{}, Dielectric{ior, {1, 1, 1}}};
  scene.needs.model.glass = true;
  return scene;
}

std::vector<Triangle> glass_box() {
  return test::inward_box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.4f, 0.3f});
}

/// Every path ends at a light that it meets with weight 1, however often it was mirrored or refracted before:
/// a clear body is invisible, to the last bit. Paths that total reflection keeps inside for good carry
/// nothing; the body's angles are such that there are none.
TEST(Glass, ClearGlassIsInvisibleInUniformLight) {
  for (const float ior : {1 / 1.3f, 1.3f, 1 / 1.5f}) {
    const Scene scene = glass_in_uniform_light(glass_box(), ior);
    for (const std::string_view integrator : {"mis", "direct", "brdf", "mis-report"}) {
      const RenderResult result = test::render_scene(scene, {"grid", integrator, "power"}, {.spp = 4});
      EXPECT_EQ(result.invalid_samples, 0u);
      const auto is_one = [](const Rgb& pixel) { return pixel == Rgb{1, 1, 1}; };
      const auto ones = std::ranges::count_if(result.image.pixels, is_one);
      EXPECT_EQ(static_cast<std::size_t>(ones), result.image.pixels.size()) << integrator << " " << ior;
    }
  }
}

}  // namespace
}  // namespace lemma
