#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "accel/accelerator.h"
#include "accel/grid_trace.h"
#include "src/core/bounds.h"
#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using test::random_direction;
using test::random_point;

std::unique_ptr<const Accelerator> make(std::string_view name, std::span<const Triangle> triangles) {
  return find_named(accelerators(), name).value()(triangles, {});
}

/// Rays of the kinds that rendering and bad luck produce, around the given box.
std::vector<Ray> rays_around(const Bounds& box, std::uint32_t count) {
  std::vector<Ray> rays;
  const Vec3 size = box.hi - box.lo;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler random(31, i, 0);
    const Vec3 a = box.lo + random_point(random) * size, b = box.lo + random_point(random) * size;
    const Vec3 outside = box.lo + (random_point(random) * 5.0f - Vec3(2)) * size;
    Vec3 axis(0);
    axis[static_cast<int>(i % 3)] = random.next() < 0.5f ? -1.0f : 1.0f;
    rays.push_back({a, random_direction(random)});
    rays.push_back({outside, b - outside});
    rays.push_back({a, axis});
    rays.push_back({a, b - a, 0, 1});
    rays.push_back({box.lo, size});
    rays.back().origin += (b - a) * 1e-3f;
  }
  return rays;
}

/// Bitwise: t, index and coordinates come from one shared routine, and both break ties by the lowest index.
void expect_same_hits(const Accelerator& a, const Accelerator& b, const std::vector<Ray>& rays) {
  std::size_t hits = 0;
  for (const Ray& ray : rays) {
    const auto hit = a.closest_hit(ray);
    ASSERT_EQ(hit, b.closest_hit(ray)) << ray.origin << ray.direction;
    ASSERT_EQ(hit.has_value(), a.occluded(ray));
    ASSERT_EQ(hit.has_value(), b.occluded(ray));
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 20u) << "too few rays hit anything to show much";
}

TEST(GridParity, EqualsBruteForceOnRandomTriangles) {
  for (const float size : {0.01f, 0.1f, 1.0f}) {
    const auto triangles = test::random_triangles(500, size, 32);
    expect_same_hits(*make("grid", triangles), *make("brute", triangles),
                     rays_around(bounds_of(triangles), 4000));
  }
}

TEST(GridParity, EqualsBruteForceOnOwnScenes) {
  for (const char* name : {"veach-mis", "cornell-box", "cornell-coplanar"}) {
    const Scene scene = test::own_scene(name, 64, 36);
    expect_same_hits(*make("grid", scene.triangles), *make("brute", scene.triangles),
                     rays_around(bounds_of(scene.triangles), 2000));
  }
}

TEST(GridParity, ResolutionChangesNothing) {
  const auto triangles = test::random_triangles(300, 0.2f, 33);
  const auto rays = rays_around(bounds_of(triangles), 2000);
  for (const std::size_t cells : {1, 10, 1000, 100000}) {
    const auto grid = find_named(accelerators(), std::string_view("grid"))
                          .value()(triangles, {{GridResolution::Rule::density, cells}});
    expect_same_hits(*grid, *make("brute", triangles), rays);
  }
}

/// Every instruction set that this machine has: the same hits, bit for bit.
TEST(GridParity, InstructionSetsAgree) {
  const auto triangles = test::random_triangles(2000, 0.1f, 39);
  const GridCells cells = build_grid_cells(triangles, {GridResolution::Rule::density, 200});
  const auto rays = rays_around(bounds_of(triangles), 2000);
  const auto brute = make("brute", triangles);
  ASSERT_FALSE(grid_traces().empty());
  for (const GridTrace& trace : grid_traces()) {
    std::printf("%s\n", trace.name);
    for (const Ray& ray : rays) {
      const ShearedRay sheared(ray);
      Hit best = no_hit(sheared);
      trace.closest(cells, ray, sheared, best);
      const auto expected = brute->closest_hit(ray);
      ASSERT_EQ(best, expected.value_or(no_hit(sheared))) << trace.name;
      ASSERT_EQ(trace.any(cells, ray, sheared), expected.has_value()) << trace.name;
    }
  }
}

/// Ranges that end at a hit or at the next number to it, from near and as far as rays are walked: the tests
/// of many triangles at a time err there, and must know it.
TEST(GridParity, RangesThatEndAtTheHit) {
  const auto triangles = test::random_triangles(300, 0.3f, 43);
  const GridCells cells = build_grid_cells(triangles, {GridResolution::Rule::density, 30});
  const auto brute = make("brute", triangles);
  constexpr float inf = std::numeric_limits<float>::infinity();
  std::size_t hits = 0;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    Sampler random(44, i, 0);
    const Vec3 to = random_point(random), way = random_direction(random) * (i % 3 == 0 ? 50.0f : 1.0f);
    const Ray whole{to - way, i % 2 == 0 ? way : normalize(way)};
    const auto hit = brute->closest_hit(whole);
    if (!hit) continue;
    ++hits;
    const std::array<std::array<float, 2>, 4> ranges{
        {{0, hit->t}, {0, std::nextafter(hit->t, inf)}, {hit->t, inf}, {std::nextafter(hit->t, 0.0f), inf}}};
    for (const auto& range : ranges) {
      const Ray ray{whole.origin, whole.direction, range[0], range[1]};
      const ShearedRay sheared(ray);
      const auto expected = brute->closest_hit(ray);
      for (const GridTrace& trace : grid_traces()) {
        Hit best = no_hit(sheared);
        trace.closest(cells, ray, sheared, best);
        ASSERT_EQ(best, expected.value_or(no_hit(sheared))) << trace.name;
        ASSERT_EQ(trace.any(cells, ray, sheared), expected.has_value()) << trace.name;
      }
    }
  }
  EXPECT_GT(hits, 1000u);
}

/// A small sphere of many triangles in a large box, in a cell of its own: the cell becomes a grid.
TEST(GridParity, CrowdedCells) {
  auto triangles = test::inward_box({-10, -10, -10}, {10, 10, 10});
  const auto ball = test::sphere_mesh({3.1f, 2.2f, 1.3f}, 0.05f, 130, 130);
  triangles.insert(triangles.end(), ball.begin(), ball.end());
  ASSERT_GT(build_grid_cells(triangles, {}).levels.size(), 1u);
  const auto grid = make("grid", triangles), brute = make("brute", triangles);
  expect_same_hits(*grid, *brute, rays_around(bounds_of(triangles), 300));
  expect_same_hits(*grid, *brute, rays_around(bounds_of(ball), 1000));
}

/// Vertices at which 2000 triangles meet: no grid takes them apart.
TEST(GridParity, TrianglesThatDoNotComeApart) {
  std::vector<Triangle> fan;
  for (const Triangle& t : test::random_triangles(2000, 0.3f, 40)) fan.push_back({Vec3(0.5f), t.v1, t.v2});
  expect_same_hits(*make("grid", fan), *make("brute", fan), rays_around(bounds_of(fan), 500));
}

/// Hits err in proportion to the distance: the further away, the more cells beside the ray hold candidates.
TEST(GridParity, OriginsAtAnyDistance) {
  for (const float size : {0.02f, 0.3f}) {
    const auto triangles = test::random_triangles(1000, size, 41);
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < 3000; ++i) {
      Sampler random(42, i, 0);
      const Vec3 to = triangles[i % triangles.size()].v0 + (random_point(random) - Vec3(0.5f)) * size;
      const Vec3 from = random_direction(random) * std::pow(10.0f, 8 * random.next());
      rays.push_back({from, i % 4 == 0 ? to - from : normalize(to - from)});
    }
    expect_same_hits(*make("grid", triangles), *make("brute", triangles), rays);
  }
}

/// Directions as long or short as floats go, in scenes of two sizes: beyond the range in which grids are
/// walked (needs_careful_walk) t underflows, so that triangles tie whose distances differ.
TEST(GridParity, DirectionsOfAnyLength) {
  std::size_t hits = 0;
  for (const float size : {1.0f, 0x1p-18f}) {
    auto triangles = test::random_triangles(300, 0.3f, 45);
    for (Triangle& t : triangles) t = {t.v0 * size, t.v1 * size, t.v2 * size};
    const auto grid = make("grid", triangles), brute = make("brute", triangles);
    for (std::uint32_t i = 0; i < 5000; ++i) {
      Sampler random(46, i, 0);
      const int exponent = static_cast<int>(i % 254) - 127;
      const Vec3 way = random_direction(random) * std::ldexp(1.0f, exponent);
      const Ray ray{random_point(random) * size, way};
      const auto hit = brute->closest_hit(ray);
      ASSERT_EQ(hit, grid->closest_hit(ray)) << exponent;
      ASSERT_EQ(hit.has_value(), grid->occluded(ray)) << exponent;
      hits += hit ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 5000u);
}

/// Directions so long that t is a few times the smallest float: triangles up to a third of the way apart tie,
/// and the one of lower index may lie in a later cell than the first hit.
TEST(GridParity, DirectionsSoLongThatDistancesTie) {
  constexpr float kSize = 0x1p-22f;
  auto triangles = test::random_triangles(3000, 0.1f, 47);
  for (Triangle& t : triangles) t = {t.v0 * kSize, t.v1 * kSize, t.v2 * kSize};
  const auto grid = make("grid", triangles), brute = make("brute", triangles);
  std::size_t hits = 0;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    Sampler random(48, i, 0);
    const int exponent = 120 + static_cast<int>(i % 6);
    const Ray ray{random_point(random) * kSize, random_direction(random) * std::ldexp(1.0f, exponent)};
    const auto hit = brute->closest_hit(ray);
    ASSERT_EQ(hit, grid->closest_hit(ray)) << exponent;
    ASSERT_EQ(hit.has_value(), grid->occluded(ray)) << exponent;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 1000u);
}

TEST(GridParity, FlatScenesAndSingleTriangles) {
  std::vector<Triangle> flat;
  for (Triangle t : test::random_triangles(200, 0.2f, 34)) {
    t.v0.y = t.v1.y = t.v2.y = 0.25f;
    flat.push_back(t);
  }
  Bounds around = bounds_of(flat);
  around.add(Vec3(0.5f, 1, 0.5f));
  expect_same_hits(*make("grid", flat), *make("brute", flat), rays_around(around, 2000));
  const std::vector<Triangle> one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}};
  expect_same_hits(*make("grid", one), *make("brute", one), rays_around(bounds_of(one), 1000));
}

/// The wall and the floor of the Veach scene lie on the faces of its box: the report's grid lost them.
TEST(GridParity, WallsOnTheBoundingBoxAreHit) {
  const auto box = test::inward_box({0, 0, 0}, {7, 5, 3});
  const auto grid = make("grid", box);
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Sampler random(35, i, 0);
    ASSERT_TRUE(grid->closest_hit({{3.3f, 2.1f, 1.7f}, random_direction(random)})) << i;
  }
}

class EveryBackend : public testing::TestWithParam<std::string_view> {};

TEST_P(EveryBackend, RangeIsOpenAtBothEnds) {
  const std::vector<Triangle> plane{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}};
  const auto accel = make(GetParam(), plane);
  const Ray ray{{0, 0, 1}, {0, 0, -1}};
  const auto with_range = [&](float t_min, float t_max) {
    return Ray{ray.origin, ray.direction, t_min, t_max};
  };
  EXPECT_TRUE(accel->closest_hit(with_range(0, 2)));
  EXPECT_FALSE(accel->closest_hit(with_range(0, 1)));
  EXPECT_FALSE(accel->closest_hit(with_range(1, 2)));
  EXPECT_FALSE(accel->occluded(with_range(0, 1)));
  EXPECT_FALSE(accel->occluded(with_range(1, 2)));
  EXPECT_FALSE(accel->closest_hit({{0, 0, 0}, {0, 0, -1}}))
      << "a ray that starts on the plane does not hit it";
}

TEST_P(EveryBackend, RaysThatAreNotFiniteHitNothing) {
  const auto triangles = test::random_triangles(100, 0.5f, 37);
  const auto accel = make(GetParam(), triangles);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const Ray& ray :
       {Ray{{nan, 0, 0}, {1, 0, 0}}, Ray{{0.5f, 0.5f, 0.5f}, {nan, 1, 0}}, Ray{{inf, 0, 0}, {1, 0, 0}},
        Ray{{0.5f, 0.5f, 0.5f}, {0, 0, 0}}, Ray{{0.5f, 0.5f, -1}, {0, 0, 1}, nan, nan}}) {
    EXPECT_FALSE(accel->closest_hit(ray));
    EXPECT_FALSE(accel->occluded(ray));
  }
}

TEST_P(EveryBackend, EmptySceneHasNoHits) {
  const auto accel = make(GetParam(), {});
  EXPECT_FALSE(accel->closest_hit({{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(accel->occluded({{0, 0, 0}, {1, 0, 0}}));
}

INSTANTIATE_TEST_SUITE_P(Backends, EveryBackend, testing::Values("brute", "grid", "embree"),
                         [](const auto& name) { return std::string(name.param); });

/// How many of the rays from a point inside a closed mesh to its vertices and edge midpoints miss it.
int leaks(const Accelerator& accel, const std::vector<Triangle>& mesh, const Vec3& from) {
  int missed = 0;
  for (const Triangle& t : mesh) {
    for (const Vec3& target :
         {t.v0, t.v1, t.v2, (t.v0 + t.v1) * 0.5f, (t.v1 + t.v2) * 0.5f, (t.v2 + t.v0) * 0.5f}) {
      if (!accel.closest_hit({from, target - from})) ++missed;
    }
  }
  return missed;
}

TEST(Watertight, NoRayLeavesAClosedSphere) {
  int embree_misses = 0, rays = 0;
  for (const float shift : {0.0f, 100.0f, 1e4f}) {
    const auto mesh = test::sphere_mesh({shift, 0, 0}, 1, 40, 40);
    const auto grid = make("grid", mesh), brute = make("brute", mesh), embree = make("embree", mesh);
    for (const Vec3& inside : {Vec3(0, 0, 0), Vec3(0.1f, 0.3f, -0.2f), Vec3(0.5f, 0, 0), Vec3(0, -0.7f, 0)}) {
      const Vec3 from = inside + Vec3(shift, 0, 0);
      EXPECT_EQ(leaks(*grid, mesh, from), 0);
      EXPECT_EQ(leaks(*brute, mesh, from), 0);
      embree_misses += leaks(*embree, mesh, from);
      rays += static_cast<int>(mesh.size()) * 6;
    }
  }
  RecordProperty("embree_misses", embree_misses);
  std::printf("Embree missed %d of %d rays at vertices and edge midpoints\n", embree_misses, rays);
}

/// Embree's answers differ from brute force where a ray passes within rounding of an edge or ties; random
/// rays all but never do (numerics: 0 to 3 of 400000). Of 20000 here more than 2 would be a fault of ours.
TEST(EmbreeParity, AgreesWithBruteForceOnRandomRays) {
  const Scene scene = test::own_scene("veach-mis", 64, 36);
  const auto embree = make("embree", scene.triangles), brute = make("brute", scene.triangles);
  int different = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Sampler random(38, i, 0);
    const Vec3 from = Vec3(-4, 0.5f, -8) + random_point(random) * Vec3(18, 12, 16);
    const Ray ray{from, random_direction(random)};
    if (embree->closest_hit(ray) != brute->closest_hit(ray)) ++different;
  }
  EXPECT_LE(different, 2);
}

}  // namespace
}  // namespace lemma
