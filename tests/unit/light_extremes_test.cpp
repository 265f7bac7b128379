// What every strategy of light sampling must bear: the ends of the range of random numbers, and lights of all
// sizes at all distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/warp.h"
#include "src/lights/light_sampler.h"
#include "src/shading/phong.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

class LightExtremes : public testing::TestWithParam<std::string_view> {
 protected:
  [[nodiscard]] static std::unique_ptr<const LightSampler> make(const std::vector<Emitter>& emitters) {
    return find_named(light_samplers(), GetParam()).value()(emitters, {});
  }
};

float power_of_ten(float lowest, float highest, Sampler& random) {
  return std::pow(10.0f, lowest + (highest - lowest) * random.next());
}

/// Spheres, quads, triangles and slivers, of sizes over four and distances over two orders of magnitude.
std::vector<Emitter> random_lights(float scale, Sampler& random) {
  std::vector<Emitter> emitters;
  const auto count = 1 + static_cast<std::uint32_t>(random.next() * 10);
  for (std::uint32_t light = 0; light < count; ++light) {
    const float size = scale * power_of_ten(-3, 1, random), kind = random.next();
    const Vec3 c = test::random_direction(random) * (scale * power_of_ten(-1, 1, random));
    const Vec3 a = test::random_direction(random) * size;
    const Vec3 across = test::random_direction(random) * size,
               b = kind < 0.7f ? across : a * 0.8f + across * 1e-3f;
    std::vector<Triangle> shape{{c, c + a, c + b}};
    if (kind < 0.1f) shape = test::sphere_mesh(c, size, 6, 8);
    if (kind >= 0.1f && kind < 0.4f) shape.push_back({c + a, c + a + b, c + b});
    for (const Emitter& e : test::emitters_of(shape, power_of_ten(-3, 3, random), light)) {
      if (length(area_vector(e.shape)) > 0) emitters.push_back(e);
    }
  }
  return emitters;
}

/// A point near an emitter or far off it, whose horizon passes a vertex of it closely.
LightQuery random_query(const LightSampler& lights, const Emitter& emitter, float scale, Sampler& random) {
  const Vec3 x = Vec3(point_at(emitter.shape, 0.3, 0.3)) +
                 test::random_direction(random) * (scale * power_of_ten(-4, 2, random));
  const Vec3 to_vertex = normalize(emitter.shape.v0 - x);
  const float above = (random.next() < 0.5f ? -1.0f : 1.0f) * power_of_ten(-6, -2, random);
  const Vec3 n = normalize(cross(test::random_direction(random), to_vertex) + to_vertex * above);
  if (random.next() < 0.5f) return lights.query(x, n);
  const Material material = make_material({}, {0.5f, 0.5f, 0.5f}, power_of_ten(0, 6, random));
  return lights.query(x, n, outline(material, test::random_direction(random)));
}

/// Whether light from the point reaches x from above the horizon, by more than rounding.
bool contributes(const Emitter& emitter, const LightQuery& at, const Vec3& y) {
  const Vec3d d = Vec3d(y) - Vec3d(at.x), normal = area_vector(emitter.shape);
  return dot(Vec3d(at.n), d) > 1e-6 * length(d) && -dot(d, normal) > 1e-5 * length(normal) * length(d);
}

/// What contributes can be drawn: else estimates are biased.
TEST_P(LightExtremes, DensityIsPositiveWhereLightComesFrom) {
  int tried = 0;
  for (std::uint32_t i = 0; i < 400; ++i) {
    Sampler random(142, i, 0);
    const float scale = power_of_ten(-3, 3, random);
    const auto emitters = random_lights(scale, random);
    const auto lights = make(emitters);
    for (int query = 0; query < 4; ++query) {
      const auto near = static_cast<std::size_t>(random.next() * static_cast<float>(emitters.size()));
      const LightQuery at = random_query(*lights, emitters[near], scale, random);
      for (std::uint32_t e = 0; e < emitters.size(); ++e) {
        const auto [b1, b2] = uniform_triangle(random.next_2d());
        const Vec3 y(point_at(emitters[e].shape, b1, b2));
        if (!contributes(emitters[e], at, y)) continue;
        ++tried;
        const float density = lights->pdf(at, e, y).value;
        EXPECT_TRUE(density > 0 && std::isfinite(density))
            << i << " " << query << " " << e << ": " << density;
      }
    }
  }
  EXPECT_GT(tried, 5000);
}

/// A pixel of seed 141 whose random number `word`, counted from 0, is 0 or the largest below 1 as a float.
struct ExtremeNumber {
  std::uint32_t pixel;
  int word;
  bool largest;
};
constexpr ExtremeNumber kExtremes[] = {{7452326, 0, false},  {2896068, 0, true},  {12654396, 1, false},
                                       {1682111, 1, true},   {3578460, 2, false}, {12919763, 2, true},
                                       {13292332, 3, false}, {5712760, 3, true}};

TEST_P(LightExtremes, EndsOfTheRangeGiveFiniteSamples) {
  int samples = 0;
  for (const auto& [pixel, word, largest] : kExtremes) {
    Sampler numbers(141, pixel, 0);
    for (int i = 0; i < word; ++i) static_cast<void>(numbers.next_bits());
    ASSERT_EQ(numbers.next(), largest ? 1 - 0x1p-24f : 0.0f);
    for (std::uint32_t i = 0; i < 200; ++i) {
      Sampler random(143, i, 0);
      const float scale = power_of_ten(-3, 3, random);
      const auto emitters = random_lights(scale, random);
      const auto lights = make(emitters);
      const LightQuery at = random_query(*lights, emitters.front(), scale, random);
      Sampler extreme(141, pixel, 0);
      const auto sample = lights->sample(at, extreme);
      if (!sample) continue;
      ++samples;
      EXPECT_NEAR(length(sample->wi), 1, 4 * 0x1p-23) << pixel << " " << i;
      EXPECT_TRUE(std::isfinite(sample->pdf.value) && sample->pdf.value > 0) << pixel << " " << i;
      EXPECT_TRUE(is_finite(sample->to_light)) << pixel << " " << i;
    }
  }
  EXPECT_GT(samples, 300);  // of 1600, less what faces away
}

/// A triangle and a parallelogram that face x, wholly above its horizon: there is always a sample.
TEST_P(LightExtremes, EndsOfTheRangeReachWhatFacesThem) {
  for (const float size : {1e-4f, 1e-2f, 1.0f, 100.0f}) {
    const Vec3 a(0, 1, 0), b(size, 1, 0), c(0, 1, size), d(size, 1, size);
    for (const std::vector<Triangle>& shape : {std::vector<Triangle>{{b, c, a}}, {{b, c, a}, {c, b, d}}}) {
      const auto emitters = test::emitters_of(shape, 1, 0);
      const auto lights = make(emitters);
      const LightQuery at = lights->query({0.2f, 0, 0.1f}, {0, 1, 0});
      for (const auto& [pixel, word, largest] : kExtremes) {
        Sampler extreme(141, pixel, 0);
        const auto sample = lights->sample(at, extreme);
        ASSERT_TRUE(sample) << size << " " << word << " " << largest;
        EXPECT_GT(sample->wi.y, 0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lights, LightExtremes,
                         testing::Values("tree", "radiance-area", "power", "solid-angle", "projected"),
                         [](const auto& name) {
                           std::string id(name.param);
                           std::ranges::replace(id, '-', '_');
                           return id;
                         });

}  // namespace
}  // namespace lemma
