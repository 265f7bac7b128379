#include "src/shading/phong_wave.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "tests/support/brdfs.h"
#include "tests/support/hemisphere.h"

namespace lemma {
namespace {

using test::direction;

constexpr float kLast = 1 - 0x1p-24f;

void expect_same_bits(float found, float expected, const char* what) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(found), std::bit_cast<std::uint32_t>(expected))
      << what << ": " << found << ", single " << expected;
}
void expect_same_bits(const Rgb& found, const Rgb& expected, const char* what) {
  expect_same_bits(found.r, expected.r, what);
  expect_same_bits(found.g, expected.g, what);
  expect_same_bits(found.b, expected.b, what);
}
void expect_same_bits(const Vec3& found, const Vec3& expected, const char* what) {
  expect_same_bits(Rgb{found.x, found.y, found.z}, {expected.x, expected.y, expected.z}, what);
}

/// Exponents of all sizes with both terms, either and none.
std::vector<Material> some_materials(bool specular, const BrdfOptions& options) {
  std::vector<Material> all;
  for (const float n : {0.0f, 1.0f, 40.0f, 1e3f, 1e5f, 1e6f}) {
    for (const Rgb& kd : {Rgb{0.3f, 0.5f, 0.1f}, Rgb{}}) {
      all.push_back(make_material(kd, {}, n, options));
      if (specular) all.push_back(make_material(kd, {0.6f, 0.2f, 0.4f}, n, options));
    }
  }
  return all;
}

/// A wave's input as single paths have it.
struct Lanes {
  std::vector<Material> material;
  std::vector<Vec3> wo, wi;
  std::vector<Sampler::ChoicePair> u;
};

/// Numbers at the ends of their range in every third lane.
Sampler::ChoicePair some_numbers(bool specular, std::size_t lane, Sampler& random) {
  constexpr std::array<float, 4> ends{0, kLast, 0.5f, 0x1p-24f};
  const double last = specular ? 1 - 0x1p-53 : double{kLast};
  Sampler::ChoicePair u = random.next_choice_pair();
  if (!specular) u.x = random.next();
  if (lane % 3 == 0) u.x = lane % 2 == 0 ? last : 0, u.y = ends[lane / 6 % ends.size()];
  return u;
}

Vec3 some_direction(std::size_t lane, Sampler& random) {
  constexpr std::array<double, 5> angles{0, 89.99, 89.99999, 90, 100};  // up, grazing, along and below
  const Vec3 any = cosine_hemisphere(random.next_2d());
  return lane % 4 == 0 ? direction(angles[lane / 4 % angles.size()]) : any;
}

/// wi as it is for light samples: any, grazing, the mirror direction, near it, opposed.
Vec3 some_light(const Material& material, const Vec3& wo, std::size_t lane, Sampler& random) {
  const Vec3 mirror = test::mirror(wo);
  const auto sample = Phong<true>(material).sample(wo, random.next_choice_pair());
  switch (lane % 5) {
    case 0:
      return mirror;
    case 1:
      return sample ? sample->wi : mirror;
    case 2:
      return {mirror.x, mirror.y, 1e-20f};
    case 3:
      return {-wo.x, -wo.y, 1e-30f};
    default:
      return some_direction(lane, random);
  }
}

Lanes some_lanes(bool specular, const BrdfOptions& options, std::uint32_t index) {
  const std::vector<Material> materials = some_materials(specular, options);
  Lanes lanes;
  Sampler random(81, index, 0);
  for (std::size_t i = 0; i < kWaveSize; ++i) {
    const std::size_t which = random.next_bits() % materials.size();
    lanes.material.push_back(materials[which]);
    lanes.wo.push_back(some_direction(i, random));
    lanes.wi.push_back(some_light(materials[which], lanes.wo.back(), i, random));
    lanes.u.push_back(some_numbers(specular, i, random));
  }
  return lanes;
}

class EveryWave : public testing::TestWithParam<BrdfOptions> {};
INSTANTIATE_TEST_SUITE_P(Brdf, EveryWave, testing::ValuesIn(test::kSamplings));

template <bool Specular>
void expect_same_values(const PhongWaves& waves, const Lanes& lanes, std::size_t count) {
  MaterialWave materials;
  VecWave wo, wi;
  for (std::size_t i = 0; i < count; ++i) {
    materials.set(i, lanes.material[i]);
    wo.set(i, lanes.wo[i]), wi.set(i, lanes.wi[i]);
  }
  BrdfValueWave values;
  waves.at(materials, wo, wi, count, values);
  for (std::size_t i = 0; i < count; ++i) {
    const BrdfValue single = Phong<Specular>(lanes.material[i]).at(lanes.wo[i], lanes.wi[i]);
    expect_same_bits(values.f[i], single.f, "f");
    expect_same_bits(values.pdf[i], single.pdf.value, "pdf");
  }
}

/// @return how many lanes have a sample
template <bool Specular>
std::size_t expect_same_samples(const PhongWaves& waves, const Lanes& lanes, std::size_t count) {
  MaterialWave materials;
  VecWave wo;
  ChoicePairWave u;
  for (std::size_t i = 0; i < count; ++i) {
    materials.set(i, lanes.material[i]);
    wo.set(i, lanes.wo[i]);
    u.x[i] = lanes.u[i].x, u.y[i] = lanes.u[i].y;
  }
  BrdfSampleWave samples;
  waves.sample(materials, wo, u, count, samples);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto single = Phong<Specular>(lanes.material[i]).sample(lanes.wo[i], lanes.u[i]);
    EXPECT_EQ(samples.pdf[i] > 0, single.has_value());
    expect_same_bits(samples.pdf[i], single ? single->pdf.value : 0, "pdf of a sample");
    if (!single) continue;
    ++found;
    expect_same_bits(samples.wi[i], single->wi, "wi");
    expect_same_bits(samples.weight[i], single->weight, "weight");
  }
  return found;
}

template <bool Specular>
void expect_same(const BrdfOptions& options) {
  const auto all = all_phong_waves(Specular, options.lobe, options.sampling);
  ASSERT_FALSE(all.empty());
  for (const PhongWaves& waves : all) {
    std::size_t found = 0;
    for (std::uint32_t wave = 0; wave < 40; ++wave) {
      SCOPED_TRACE(waves.name);
      const Lanes lanes = some_lanes(Specular, options, wave);
      const std::size_t count = wave % 2 == 0 ? kWaveSize : 6 * wave + 1;
      expect_same_values<Specular>(waves, lanes, count);
      found += expect_same_samples<Specular>(waves, lanes, count);
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(found, 2000u);  // of 7540
  }
}

/// Every instruction set that this machine has: the bits of single paths.
TEST_P(EveryWave, IsAsSinglePaths) {
  expect_same<true>(GetParam());
  expect_same<false>(GetParam());
}

}  // namespace
}  // namespace lemma
