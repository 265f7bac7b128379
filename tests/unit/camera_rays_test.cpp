#include "src/render/camera_rays.h"

#include <gtest/gtest.h>

namespace lemma {
namespace {

constexpr int kX = 96, kY = 41;

Camera some_camera() {
  return Camera({{1, 2, 3}, {-0.5f, 0.7f, -2}, {0.1f, 1, 0}, 50, 640, 360});
}

/// What CameraRays is to give, found by Sampler and Camera alone.
void expect_rays_of_single_samples(const RenderSettings& settings, std::size_t count) {
  const Camera camera = some_camera();
  constexpr std::size_t first = 32;
  CameraRays block(camera, settings, kX, kY, count, first);
  VecWave directions;
  SamplerWave random;
  for (const std::uint32_t sample : {0u, 1u, 2u, 3u, 4u, 77u, 1u << 20}) {
    block.aim(sample, directions, random);
    for (std::size_t i = 0; i < count; ++i) {
      const int x = kX + static_cast<int>(i);
      Sampler one(settings.seed, static_cast<std::uint32_t>(kY * camera.width() + x), sample,
                  settings.sequence, settings.replicates);
      const Vec2 u = one.next_2d();
      const Ray ray = camera.ray_through(static_cast<float>(x) + u.x, static_cast<float>(kY) + u.y);
      ASSERT_EQ(directions[first + i], ray.direction) << "pixel " << i << ", sample " << sample;
      Sampler rest = random[first + i];
      for (int k = 0; k < 9; ++k) ASSERT_EQ(rest.next_bits(), one.next_bits());
    }
  }
}

TEST(CameraRays, AreThoseOfSingleSamples) {
  for (const Sequence sequence : {Sequence::sobol, Sequence::independent}) {
    for (const std::uint32_t replicates : {1u, 3u}) {
      for (const std::size_t count : {std::size_t{1}, std::size_t{5}, PixelBlock::kSize}) {
        expect_rays_of_single_samples({.seed = 7, .sequence = sequence, .replicates = replicates}, count);
      }
    }
  }
}

/// Every instruction set that this machine has: the same directions, bit for bit.
TEST(CameraRays, InstructionSetsAgree) {
  const Camera camera = some_camera();
  const auto& all = all_aim_rays();
  ASSERT_FALSE(all.empty());
  Sampler random(61, 0, 0);
  PixelBlock pixels;
  pixels.x = kX, pixels.y = kY;
  for (int k = 0; k < 1000; ++k) {
    for (std::size_t i = 0; i < PixelBlock::kSize; ++i) {
      pixels.set(i, {random.next_bits(), random.next_bits(), random.next_bits()});
    }
    const std::uint32_t reversed_index = random.next_bits();
    PixelBlock::Directions expected;
    all.back().function(camera, pixels, reversed_index, expected);
    for (const AimRays& set : all) {
      PixelBlock::Directions directions;
      set.function(camera, pixels, reversed_index, directions);
      ASSERT_EQ(directions.x, expected.x) << set.name;
      ASSERT_EQ(directions.y, expected.y) << set.name;
      ASSERT_EQ(directions.z, expected.z) << set.name;
    }
  }
}

}  // namespace
}  // namespace lemma
