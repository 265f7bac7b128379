#include <gtest/gtest.h>

#include <optional>
#include <set>

#include "accel/grid_cells.h"
#include "accel/grid_overlap.h"
#include "accel/grid_walk.h"
#include "src/core/warp.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

TEST(CellCounts, FollowTheShapeOfTheBox) {
  using Counts = std::array<int, 3>;
  EXPECT_EQ(cell_counts({1, 1, 1}, 1000), (Counts{10, 10, 10}));
  EXPECT_EQ(cell_counts({4, 2, 1}, 8000), (Counts{40, 20, 10}));
  EXPECT_EQ(cell_counts({1, 0, 1}, 100), (Counts{10, 1, 10}));     // flat
  EXPECT_EQ(cell_counts({1, 1e-9, 1}, 100), (Counts{10, 1, 10}));  // nearly flat
  EXPECT_EQ(cell_counts({0, 0, 5}, 100), (Counts{1, 1, 100}));     // a line
  EXPECT_EQ(cell_counts({0, 0, 0}, 100), (Counts{1, 1, 1}));       // a point
  EXPECT_EQ(cell_counts({1e-30, 2e-30, 1e-30}, 16), (Counts{2, 4, 2}));
}

TEST(GridCells, RulesOfResolution) {
  const auto triangles = test::random_triangles(1000, 0.05f, 1);
  const auto cells = [&](const GridResolution& resolution) {
    const GridCells grid = build_grid_cells(triangles, resolution);
    return grid.counts[0] * grid.counts[1] * grid.counts[2];
  };
  // Rounding each axis to whole cells changes the number by less than half a cell an axis: 1.5 / 10 of 1000
  // cells.
  EXPECT_NEAR(static_cast<double>(cells({})), 2000, 0.12 * 2000);
  EXPECT_NEAR(static_cast<double>(cells({GridResolution::Rule::twenty_seven, 0})), 27000, 0.05 * 27000);
  EXPECT_NEAR(static_cast<double>(cells({GridResolution::Rule::density, 100000})), 100000, 0.04 * 100000);
}

/// A point of the triangle in a box proves that they overlap: the test must never deny it.
TEST(BoxOverlap, NeverDeniesAPointOfTheTriangle) {
  int overlaps = 0;
  for (const Triangle& t : test::random_triangles(300, 0.5f, 2)) {
    const Vec3d half(0.05, 0.1, 0.02);
    const BoxOverlap overlap(t, half);
    Sampler random(3, static_cast<std::uint32_t>(overlaps), 0);
    for (int i = 0; i < 100; ++i) {
      const auto [b1, b2] = uniform_triangle(random.next_2d());
      const Vec3d inside = Vec3d(test::random_point(random)) * 2.0 - Vec3d(1.0);
      ASSERT_TRUE(overlap.with_box_at(point_at(t, b1, b2) + inside * half));
      ++overlaps;
    }
  }
}

TEST(BoxOverlap, DeniesBoxesBesideTheTriangle) {
  const Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const BoxOverlap overlap(t, {0.1, 0.1, 0.1});
  EXPECT_TRUE(overlap.with_box_at({0.3, 0.3, 0.05}));
  EXPECT_FALSE(overlap.with_box_at({0.3, 0.3, 0.11}));  // off its plane
  EXPECT_FALSE(overlap.with_box_at({0.8, 0.8, 0}));     // beyond its hypotenuse
}

/// The cell that p lies in, if it is occupied and p not so near its faces that a walk may miss it.
std::optional<std::size_t> occupied_cell_at(const GridCells& grid, const Vec3d& p) {
  std::array<int, 3> cell{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double position = (p[k] - grid.lo[k]) * grid.cells_per_unit[k];
    const double rest = position - std::floor(position);
    if (rest < 0x1p-10 || rest > 1 - 0x1p-10 || position < 0 || position >= grid.counts[axis])
      return std::nullopt;
    cell[axis] = static_cast<int>(position);
  }
  const std::size_t index = grid.index(cell);
  return grid.clearances(0)[index] == 0 ? std::optional(index) : std::nullopt;
}

/// Steps along rays find no occupied cell that the walk does not visit.
TEST(GridWalk, VisitsTheOccupiedCellsAlongTheRay) {
  const GridCells grid = build_grid_cells(test::random_triangles(300, 0.05f, 4), {});
  std::size_t visits = 0;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    Sampler random(5, i, 0);
    const Vec3 from = test::random_point(random) * 3.0f - Vec3(1), to = test::random_point(random);
    const Ray ray{from, to - from};
    std::set<std::size_t> visited;
    for (GridWalk walk(grid, WalkedRay(ray), ray.t_max); !walk.done(); walk.step(ray.t_max)) {
      EXPECT_TRUE(visited.insert(walk.cell()).second) << "a cell was visited twice";
    }
    visits += visited.size();
    for (double t = 0; t < 3; t += 0.01) {
      const auto cell = occupied_cell_at(grid, Vec3d(ray.origin) + Vec3d(ray.direction) * t);
      EXPECT_TRUE(!cell || visited.contains(*cell));
    }
  }
  EXPECT_GT(visits, 2000u);
}

/// The cube that a clearance speaks of is empty, and the next larger one is not or leaves the grid's far
/// side.
TEST(GridCells, ClearancesAreThoseOfTheLargestEmptyCubes) {
  const GridCells grid =
      build_grid_cells(test::random_triangles(12, 0.1f, 6), {GridResolution::Rule::density, 1000});
  const auto [nx, ny, nz] = grid.counts;
  const auto cube_is_empty = [&](int x, int y, int z, unsigned octant, int size) {
    const auto end = [&](int from, unsigned bit) {
      return (octant & bit) != 0 ? from + size - 1 : from - size + 1;
    };
    const auto inside = [](int i, int n) { return std::clamp(i, 0, n - 1); };
    const int x1 = inside(end(x, 1), nx), y1 = inside(end(y, 2), ny), z1 = inside(end(z, 4), nz);
    for (int w = std::min(z, z1); w <= std::max(z, z1); ++w)
      for (int v = std::min(y, y1); v <= std::max(y, y1); ++v)
        for (int u = std::min(x, x1); u <= std::max(x, x1); ++u)
          if (!grid.list(grid.index({u, v, w})).empty()) return false;
    return true;
  };
  for (unsigned octant = 0; octant < 8; ++octant) {
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
          const int clearance = grid.clearances(octant)[grid.index({x, y, z})];
          ASSERT_TRUE(clearance == 0 || cube_is_empty(x, y, z, octant, clearance));
          ASSERT_TRUE(clearance == 255 || !cube_is_empty(x, y, z, octant, clearance + 1));
        }
      }
    }
  }
}

}  // namespace
}  // namespace lemma
