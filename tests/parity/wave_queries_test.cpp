#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "accel/accelerator.h"
#include "accel/hit_wave.h"
#include "accel/watertight.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using test::random_direction;
using test::random_point;

constexpr std::size_t kSomeCounts[] = {0, 1, 15, 16, 17, kWaveSize};
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// From and to points of the unit cube and around it, with all ranges that rendering and bad luck produce:
/// a fifth of them is not finite or empty.
Ray some_ray(std::uint32_t i) {
  Sampler random(61, i, 0);
  const Vec3 from = random_point(random) * 2.0f - Vec3(0.5f), to = random_point(random);
  constexpr float kMin = std::numeric_limits<float>::min();
  switch (i % 20) {
    case 0:
      return {{kNan, 0, 0}, to};
    case 1:
      return {from, {0, kInf, 1}};
    case 2:
      return {from, {0, 0, kNan}};
    case 3:
      return {from, to - from, 0, kNan};
    case 4:
      return {from, to - from, 0, 0};
    case 5:
      return {from, to - from, 0, -1};
    case 6:
      return {from, to - from, 0, kMin * random.next()};
    case 7:
      return {from, {0, 0, 0}};
    case 8:
      return {from, {0, 0, i % 40 < 20 ? 1.0f : -1.0f}};
    case 9:
    case 10:
    case 11:
      return {from, to - from, 0, 1};
    case 12:
      return {from, to - from, 0, 0.1f};
    default:
      return {from, random_direction(random)};
  }
}

/// A wave of rays from the k-th on; from the count on as many that hit something, which nobody asks for.
RayWave some_rays(std::uint32_t k, std::size_t count) {
  RayWave rays;
  for (std::uint32_t i = 0; i < kWaveSize; ++i) rays.set(i, some_ray(i < count ? k + i : 13));
  return rays;
}

class WaveQueries : public testing::TestWithParam<std::string_view> {};

/// What queries of waves and of single rays answer is the same, bit for bit.
/// @return how many rays hit something
std::size_t expect_same_answers(const Accelerator& accel, const RayWave& rays, std::size_t count,
                                HitWave& hits, Coherence coherence = Coherence::none) {
  Wave<std::uint8_t> blocked;
  accel.closest_hits(rays, count, coherence, hits);
  accel.occluded_rays(rays, count, blocked);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<Hit> hit = accel.closest_hit(rays[i]);
    EXPECT_EQ(hits.is_hit(i), hit.has_value()) << rays[i].origin << rays[i].direction << rays[i].t_max;
    EXPECT_EQ(hit ? hits[i] : Hit{}, hit.value_or(Hit{})) << rays[i].origin << rays[i].direction;
    EXPECT_EQ(blocked[i], accel.occluded(rays[i]) ? 1 : 0) << rays[i].origin << rays[i].direction;
    found += hit ? 1 : 0;
  }
  return found;
}

TEST_P(WaveQueries, GiveTheSameAsSingleRays) {
  const auto triangles = test::random_triangles(500, 0.5f, 36);
  const auto accel = find_named(accelerators(), GetParam()).value()(triangles, {});
  HitWave hits;
  std::size_t found = 0, asked = 0;
  for (std::uint32_t k = 0; k < 60; ++k) {
    const std::size_t count = kSomeCounts[k % std::size(kSomeCounts)];
    RayWave rays = some_rays(k * kWaveSize, count);
    found += expect_same_answers(*accel, rays, count, hits);
    asked += count;
    // Ranges that end at the hit, which is outside of them, or at the next number.
    for (std::size_t i = 0; i < count; ++i) {
      if (hits.is_hit(i)) rays.t_max[i] = i % 2 == 0 ? hits.t[i] : std::nextafter(hits.t[i], kInf);
    }
    expect_same_answers(*accel, rays, count, hits);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(found, asked / 4);
  EXPECT_LT(found, asked * 3 / 4);
}

/// Rows of camera rays, some of them ended before: where there are no ties they find the same as single rays.
TEST_P(WaveQueries, GiveTheSameInCoherentSteps) {
  const auto triangles = test::random_triangles(500, 0.5f, 36);
  const auto accel = find_named(accelerators(), GetParam()).value()(triangles, {});
  RayWave rays;
  HitWave hits;
  std::size_t found = 0;
  for (std::uint32_t k = 0; k < 40; ++k) {
    Sampler random(65, k, 0);
    const Vec3 from = random_point(random) * 4 - Vec3(2);
    for (std::size_t i = 0; i < kWaveSize; ++i) {
      const Vec3 to(static_cast<float>(i % 16) / 16, static_cast<float>(i / 16) / 16, random.next());
      rays.set(i, {from, to - from, 0, k % 2 == 0 || i % 16 < 5 ? kInf : 0});
    }
    found += expect_same_answers(*accel, rays, kWaveSize, hits, Coherence::steps);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(found, std::size_t{40} * kWaveSize / 4);
}

/// Rays to vertices and edge midpoints of a closed mesh, all of whose triangles are there twice: which of
/// them is found depends on roundings and on the order of tests.
TEST_P(WaveQueries, GiveTheSameAtEdgesAndTies) {
  auto triangles = test::sphere_mesh({0, 0, 0}, 1, 12, 12);
  const std::vector<Triangle> once = triangles;
  triangles.insert(triangles.end(), once.begin(), once.end());
  const auto accel = find_named(accelerators(), GetParam()).value()(triangles, {});
  RayWave rays;
  HitWave hits;
  for (std::uint32_t k = 0; k < 20; ++k) {
    Sampler random(64, k, 0);
    for (std::size_t i = 0; i < kWaveSize; ++i) {
      const Triangle& t = once[(k * kWaveSize + i) % once.size()];
      const Vec3 from = (random_point(random) - Vec3(0.5f)) * (k % 2 == 0 ? 1.0f : 8.0f);
      rays.set(i, {from, (i % 2 == 0 ? t.v0 : (t.v0 + t.v1) * 0.5f) - from});
    }
    EXPECT_GT(expect_same_answers(*accel, rays, kWaveSize, hits), kWaveSize / 2);
    ASSERT_FALSE(HasFailure());
  }
}

/// What earlier queries left in the lanes does not matter, nor whether there is any triangle.
TEST_P(WaveQueries, EmptySceneHasNoHits) {
  const auto accel = find_named(accelerators(), GetParam()).value()({}, {});
  const RayWave rays = some_rays(0, kWaveSize);
  HitWave hits;
  Wave<std::uint8_t> blocked;
  for (std::size_t i = 0; i < kWaveSize; ++i) hits.triangle[i] = 7, blocked[i] = 1;
  accel->closest_hits(rays, kWaveSize, Coherence::none, hits);
  accel->occluded_rays(rays, kWaveSize, blocked);
  for (std::size_t i = 0; i < kWaveSize; ++i) {
    ASSERT_FALSE(hits.is_hit(i));
    ASSERT_EQ(blocked[i], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, WaveQueries, testing::Values("brute", "grid", "embree"),
                         [](const auto& name) { return std::string(name.param); });

/// Triangles of every shape: also needles, those whose vertices lie on a line or are one point, and those
/// parallel to axes.
std::vector<Triangle> some_triangles() {
  std::vector<Triangle> triangles = test::random_triangles(400, 0.5f, 62);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangle& t = triangles[i];
    switch (i % 8) {
      case 0:
        t.v2 = t.v1;
        break;
      case 1:
        t.v1 = t.v2 = t.v0;
        break;
      case 2:
        t.v2 = (t.v0 + t.v1) * 0.5f;
        break;
      case 3:
        t.v1.x = t.v2.x = t.v0.x;
        break;
      case 4:
        t.v1.y = t.v2.y = t.v0.y;
        break;
      case 5:
        t.v1.z = t.v2.z = t.v0.z;
        break;
      default:
        break;
    }
  }
  return triangles;
}

/// A ray that may have been found to hit the triangle: through its inside, edges and vertices or past them by
/// some roundings, along axes, and seeing it edge-on; some pass it by far.
Ray ray_near(const Triangle& t, std::uint32_t i) {
  Sampler random(63, i, 0);
  const float u = random.next(), v = random.next(), past = (random.next() - 0.5f) * 1e-6f;
  Vec3 to = t.v0 * (1 - u) + t.v1 * u;
  if (i % 5 == 0) to = t.v0 * ((1 - u) * (1 - v)) + t.v1 * (u * (1 - v)) + t.v2 * v;
  if (i % 5 == 1) to += (to - t.v2) * past;
  if (i % 5 == 2) to = t.v0;
  if (i % 5 == 3 && i % 25 == 3) to = random_point(random);
  Vec3 way = random_direction(random);
  if (i % 7 < 3) way = Vec3(0), way[static_cast<int>(i % 3)] = v < 0.5f ? -1.0f : 1.0f;
  if (i % 7 == 3 && t.v1 != t.v2) way = (t.v1 - t.v2) * 2.0f;
  if (i % 7 == 4) way.y = way.z = -way.x;
  return {to - way, way};
}

/// What decides which of its formulas hit_on() takes.
struct CasesOfHits {
  void add(const Ray& ray, const Triangle& t) {
    const ShearedRay sheared(ray);
    const watertight::Weights e = watertight::weights(
        watertight::shear(sheared, t.v0), watertight::shear(sheared, t.v1), watertight::shear(sheared, t.v2));
    ++(e.sum == 0 ? edge_on : watertight::passes_through(e) ? through : past);
  }
  int edge_on = 0, through = 0, past = 0;
};

void expect_same_bits(const Hit& a, const Hit& b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  ASSERT_EQ(bits(a.t), bits(b.t));
  ASSERT_EQ(bits(a.b1), bits(b.b1));
  ASSERT_EQ(bits(a.b2), bits(b.b2));
  ASSERT_EQ(a.triangle, b.triangle);
}

bool is_on_triangle(const Hit& hit) {
  return hit.b1 >= 0 && hit.b1 <= 1 && hit.b2 >= 0 && hit.b2 <= 1 - hit.b1;
}

/// Every instruction set that this machine has: the hits of single rays, bit for bit.
TEST(HitWaves, InstructionSetsGiveTheHitsOfSingleRays) {
  const std::vector<Triangle> triangles = some_triangles();
  ASSERT_FALSE(all_hits_on_triangles().empty());
  for (const HitsOnTriangles& hits_on : all_hits_on_triangles()) {
    SCOPED_TRACE(hits_on.name);
    CasesOfHits cases;
    for (std::uint32_t k = 0; k < 300; ++k) {
      const std::size_t count = kSomeCounts[k % std::size(kSomeCounts)];
      RayWave rays;
      HitWave hits;
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t triangle = (k * 7919 + i * 104729) % static_cast<std::uint32_t>(triangles.size());
        hits.triangle[i] = i % 9 == 0 ? HitWave::kNoTriangle : triangle;
        rays.set(i, ray_near(triangles[triangle], 1000 * k + i));
      }
      hits_on.function(triangles, rays, count, hits);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(hits.is_hit(i), i % 9 != 0);
        if (!hits.is_hit(i)) continue;
        const Triangle& triangle = triangles[hits.triangle[i]];
        expect_same_bits(hits[i], hit_on(ShearedRay(rays[i]), triangle, hits.triangle[i]));
        ASSERT_TRUE(is_on_triangle(hits[i]));
        cases.add(rays[i], triangle);
      }
    }
    EXPECT_GT(std::min({cases.edge_on, cases.through, cases.past}), 1000);
    std::printf("%s: %d hits edge-on, %d inside, %d moved onto the triangle\n", hits_on.name, cases.edge_on,
                cases.through, cases.past);
  }
}

}  // namespace
}  // namespace lemma
