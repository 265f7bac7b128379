#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/render/tone_map.h"
#include "tests/support/images.h"

namespace lemma {
namespace {

/// Returns a bad value for some samples.
class Faulty final : public Integrator {
 public:
  explicit Faulty(Rgb bad) : bad_(bad) {}
  Rgb radiance(const Ray&, const std::optional<Hit>&, const World&, Tracer&, Sampler& random) const override {
    return random.next() < 0.01f ? bad_ : Rgb{1, 2, 3};
  }

 private:
  Rgb bad_;
};

TEST(Render, InvalidSamplesAreCountedLocatedAndLeftOut) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Scene scene = test::own_scene("cornell-box", 40, 30);
  const auto accel = find_named(accelerators(), std::string_view("brute")).value()(scene.triangles, {});
  const auto lights =
      find_named(light_samplers(), std::string_view("power")).value()(scene.emitters, scene.triangles);
  for (const Rgb bad : {Rgb{nan, 0, 0}, Rgb{0, inf, 0}, Rgb{0, 0, -1}}) {
    const RenderResult result = render({scene, *accel, *lights}, Faulty(bad), {.spp = 8, .seed = 3}, nullptr);
    // Binomial: 9600 draws of 0.01, mean 96, five standard deviations of 10.
    EXPECT_NEAR(static_cast<double>(result.invalid_samples), 96, 50);
    ASSERT_EQ(result.first_invalid.size(), RenderResult::kReportedInvalid);
    EXPECT_LT(result.first_invalid[0].sample, 8u);
    for (const Rgb& pixel : result.image.pixels) ASSERT_EQ(pixel, (Rgb{1, 2, 3}));
  }
}

TEST(Render, DepthLimitCutsAndSaysSo) {
  const Scene scene = test::own_scene("cornell-box", 16, 16);
  IntegratorOptions options;
  options.max_depth = 1;
  const auto cut = test::render_scene(scene, {"embree", "mis", "power", options}, {.spp = 8});
  const auto whole = test::render_scene(scene, {"embree", "mis", "power"}, {.spp = 8});
  EXPECT_GT(cut.counts.paths_cut, 0u);
  EXPECT_EQ(whole.counts.paths_cut, 0u);
  EXPECT_LT(test::image_mean(cut.image), test::image_mean(whole.image));
}

TEST(Camera, SeesTheCornersOfItsView) {
  const Camera camera({{0, 0, 0}, {0, 0, -2}, {0, 1, 0}, 90, 200, 100});
  const auto expect_direction = [&](float x, float y, const Vec3& expected) {
    const Vec3 d = camera.ray_through(x, y).direction;
    EXPECT_LT(length(d - normalize(expected)), 1e-6f) << d;
  };
  expect_direction(100, 50, {0, 0, -1});
  expect_direction(100, 0, {0, 1, -1});  // top: fovy is vertical
  expect_direction(0, 50, {-2, 0, -1});  // left
  expect_direction(200, 100, {2, -1, -1});
}

TEST(PixelSum, KeepsSmallSamplesBesideManyLargeOnes) {
  PixelSum sum;
  constexpr int count = 1 << 25;  // a float sum of ones stops at 2^24
  for (int i = 0; i < count; ++i) sum.add({1, 1e-3f, 0});
  EXPECT_EQ(sum.mean(), (Rgb{1, 1e-3f, 0}));
}

TEST(ToneMap, CurvesAtTheirEnds) {
  const ToneMap srgb;
  EXPECT_EQ(srgb({0, 0, 0}), Rgb{});
  EXPECT_NEAR(srgb({1, 0, 0}).r, 1, 0x1p-23);  // 1.055 - 0.055, two roundings
  EXPECT_EQ(srgb({7, 0, 0}), srgb({1, 0, 0}));
  EXPECT_NEAR(srgb({0.5f, 0, 0}).r, 0.735357f, 1e-5f);
  const ToneMap report{ToneCurve::gamma, 0, 380, 0.25f};
  EXPECT_EQ(report({0, 380, 1000}), (Rgb{0, 1, 1}));
  EXPECT_NEAR(report({38, 0, 0}).r, std::pow(0.1, 0.25), 1e-6);
  const ToneMap brighter{ToneCurve::gamma, 1, 2, 1};
  EXPECT_FLOAT_EQ(brighter({0.5f, 0, 0}).r, 0.5f);
}

}  // namespace
}  // namespace lemma
