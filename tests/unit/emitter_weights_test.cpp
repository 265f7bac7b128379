#include "src/lights/emitter_weights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/lights/projected_triangle.h"
#include "src/lights/spherical_triangle.h"
#include "tests/support/images.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using Measure = EmitterWeights::Measure;
using test::two_spheres;

EmitterBlock::Values weigh(WeighEmitters::Function function, const EmitterBlock& block,
                           const Viewpoint& from) {
  EmitterBlock::Values weights;
  function(block, from, weights);
  return weights;
}

/// Emitters of all sizes, and points around and on them.
std::vector<Emitter> mixed_emitters() {
  auto emitters = test::emitters_of(test::random_triangles(64, 0.02f, 101), 1, 0);
  for (const Emitter& e : test::emitters_of(test::random_triangles(50, 2, 102), 3, 1)) emitters.push_back(e);
  return emitters;
}

std::vector<Viewpoint> viewpoints(const std::vector<Emitter>& emitters) {
  std::vector<Viewpoint> points;
  for (std::uint32_t i = 0; i < 300; ++i) {
    Sampler random(103, i, 0);
    const Triangle& t = emitters[i % emitters.size()].shape;
    const Vec3 on_plane(point_at(t, 3 * random.next() - 1, 3 * random.next() - 1));
    points.push_back({i % 2 == 0 ? test::random_point(random) : on_plane, test::random_direction(random)});
  }
  return points;
}

std::vector<EmitterBlock> blocks_of(std::span<const Emitter> emitters) {
  std::vector<EmitterBlock> blocks;
  for (; emitters.size() > EmitterBlock::kSize; emitters = emitters.subspan(EmitterBlock::kSize)) {
    blocks.emplace_back(emitters.first(EmitterBlock::kSize));
  }
  blocks.emplace_back(emitters);
  return blocks;
}

/// Every instruction set that this machine has: the same weights, bit for bit.
TEST(EmitterWeights, InstructionSetsAgree) {
  const auto emitters = mixed_emitters();
  const auto& all = all_weigh_emitters();
  ASSERT_FALSE(all.empty());
  for (const WeighEmitters& set : all) {
    std::printf("%s\n", set.name);
    for (const EmitterBlock& block : blocks_of(emitters)) {
      for (const Viewpoint& from : viewpoints(emitters)) {
        for (const auto function :
             {&WeighEmitters::by_solid_angle, &WeighEmitters::by_projected_solid_angle}) {
          ASSERT_EQ(weigh(set.*function, block, from), weigh(all.back().*function, block, from)) << set.name;
        }
      }
    }
  }
}

/// Half of the points lie in the plane of an emitter up to rounding.
TEST(EmitterWeights, ArePositiveExactlyWhereTheEmitterEmits) {
  const auto emitters = mixed_emitters();
  const auto blocks = blocks_of(emitters);
  const WeighEmitters& fastest = all_weigh_emitters().front();
  for (const Viewpoint& from : viewpoints(emitters)) {
    for (std::size_t i = 0; i < emitters.size(); ++i) {
      const EmitterBlock& block = blocks[i / EmitterBlock::kSize];
      const std::size_t k = i % EmitterBlock::kSize;
      const bool emits = emits_towards(emitters[i], from.x);
      ASSERT_EQ(weigh(fastest.by_solid_angle, block, from)[k] > 0, emits) << from.x << " " << i;
      const float projected = weigh(fastest.by_projected_solid_angle, block, from)[k];
      if (!emits) {
        ASSERT_EQ(projected, 0);
      } else if (test::irradiance(emitters[i], from.x, from.n) > 0) {
        ASSERT_GT(projected, 0) << from.x << " " << i;
      }
    }
  }
}

TEST(EmitterWeights, AreLuminanceTimesSolidAngle) {
  const auto emitters = two_spheres();
  const auto blocks = blocks_of(emitters);
  const WeighEmitters& fastest = all_weigh_emitters().front();
  const Viewpoint from{{0.3f, 0, -0.2f}, {0, 1, 0}};
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const Emitter& e = emitters[i];
    const EmitterBlock& block = blocks[i / EmitterBlock::kSize];
    const std::size_t k = i % EmitterBlock::kSize;
    if (!emits_towards(e, from.x)) continue;
    const double expected = luminance(e.radiance) * SphericalTriangle(e.shape, from.x).solid_angle();
    // The edge form in float32: 4e-7 at most for well-shaped triangles seen at a cosine near 1; the numerator
    // cancels as 1 / cosine, here down to 0.02.
    EXPECT_NEAR(weigh(fastest.by_solid_angle, block, from)[k], expected, 2e-5 * expected) << i;
    // The cosine at the surface, above 0.6 here, differs by less than 2 % over triangles of 0.2 rad.
    const double projected =
        luminance(e.radiance) * ProjectedTriangle(e.shape, from.x, from.n).projected_solid_angle();
    EXPECT_NEAR(weigh(fastest.by_projected_solid_angle, block, from)[k], projected, 0.02 * projected) << i;
  }
}

/// Choices at regular u fall on each emitter as often as its probability says, up to one at either end of its
/// range; and probabilities sum to 1.
TEST(EmitterWeights, ChoicesHaveTheirProbability) {
  const Scene scene = test::own_scene("veach-mis", 16, 9);
  for (const Measure measure : {Measure::solid_angle, Measure::projected_solid_angle}) {
    const EmitterWeights weights(scene.emitters, measure);
    LightQuery at{{4, 0.01f, 0}, {0, 1, 0}};
    weights.prepare(at);
    constexpr int draws = 200000;
    std::vector<int> counts(scene.emitters.size());
    for (int i = 0; i < draws; ++i) {
      const auto choice = weights.choose(at, (i + 0.5) / draws);
      ASSERT_TRUE(choice);
      ASSERT_EQ(choice->pmf, weights.pmf(at, choice->emitter));
      ++counts[choice->emitter];
    }
    double sum = 0;
    for (std::uint32_t e = 0; e < counts.size(); ++e) {
      const double pmf = weights.pmf(at, e);
      ASSERT_NEAR(counts[e], draws * pmf, 1.1) << e;
      sum += pmf;
    }
    // Blocks are summed in float32 in 16 chains of 4.
    EXPECT_NEAR(sum, 1, 4 * 0x1p-24);
  }
}

}  // namespace
}  // namespace lemma
