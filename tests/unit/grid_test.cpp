#include <gtest/gtest.h>

#include <bit>
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
  EXPECT_NEAR(static_cast<double>(cells({})), 4000, 0.1 * 4000);
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

/// The list of the cell that p lies in, if it is occupied and p not within rounding of its faces.
std::optional<std::size_t> list_inside(const GridCells& grid, const Vec3d& p) {
  std::array<int, 3> cell{};
  for (int k = 0; k < 3; ++k) {
    const double position = (p[k] - grid.lo[k]) * grid.cells_per_unit[k];
    const double rest = position - std::floor(position);
    if (rest < 1e-6 || rest > 1 - 1e-6) return std::nullopt;
    cell[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(position));
    if (position < 0 || position >= grid.counts[static_cast<std::size_t>(k)]) return std::nullopt;
  }
  const Brick& brick = grid.bricks[grid.brick_index(cell[0] / 4, cell[1] / 4, cell[2] / 4)];
  const std::uint64_t bit = std::uint64_t{1} << (cell[0] % 4 + cell[1] % 4 * 4 + cell[2] % 4 * 16);
  if ((brick.occupied & bit) == 0) return std::nullopt;
  return brick.first_list + static_cast<std::size_t>(std::popcount(brick.occupied & (bit - 1)));
}

/// The lists of the cells along a ray, in order, are those that a search of points along it finds.
TEST(GridWalk, VisitsTheOccupiedCellsAlongTheRay) {
  const GridCells grid = build_grid_cells(test::random_triangles(300, 0.05f, 4), {});
  std::size_t visits = 0;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    Sampler random(5, i, 0);
    const Vec3 from = test::random_point(random) * 3.0f - Vec3(1), to = test::random_point(random);
    const Ray ray{from, to - from};
    std::set<std::size_t> visited;
    double left = 0;
    for (GridWalk walk(grid, WalkedRay(ray), ray.t_max); !walk.done(); walk.step(ray.t_max)) {
      EXPECT_GE(walk.cell_exit(), left - 1e-12);
      left = walk.cell_exit();
      EXPECT_TRUE(visited.insert(walk.list()).second) << "a cell was visited twice";
    }
    visits += visited.size();
    for (double t = 0; t < 3; t += 0.01) {
      const auto list = list_inside(grid, Vec3d(ray.origin) + Vec3d(ray.direction) * t);
      EXPECT_TRUE(!list || visited.contains(*list));
    }
  }
  EXPECT_GT(visits, 2000u);
}

}  // namespace
}  // namespace lemma
