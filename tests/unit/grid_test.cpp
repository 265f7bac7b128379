#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "accel/grid_cells.h"
#include "accel/grid_overlap.h"
#include "accel/grid_resolution.h"
#include "accel/grid_trace.h"
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
    return build_grid_cells(triangles, resolution).levels.front().cell_count();
  };
  // Rounding each axis to whole cells changes the number by less than half a cell an axis: 1.5 / 10 of 1000
  // cells.
  EXPECT_NEAR(static_cast<double>(cells({})), 2000, 0.12 * 2000);  // few triangles: 2 a triangle
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
std::optional<std::uint32_t> occupied_cell_at(const GridCells& grid, const GridLevel& level, const Vec3d& p) {
  std::array<int, 3> place{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double position = (p[k] - level.lo[k]) * level.cells_per_unit[k];
    const double rest = position - std::floor(position);
    if (rest < 0x1p-10 || rest > 1 - 0x1p-10 || position < 0 || position >= level.counts[axis])
      return std::nullopt;
    place[axis] = static_cast<int>(position);
  }
  const std::uint32_t cell = level.index(place);
  return grid.is_occupied(level, cell) ? std::optional(cell) : std::nullopt;
}

/// A scene's level and another: 41,000 triangles in 1000 cells, of which 40,000 within one.
GridCells grid_of_levels(std::vector<Triangle>& triangles) {
  triangles = test::random_triangles(1000, 0.05f, 4);
  for (Triangle t : test::random_triangles(40000, 0.02f, 7)) {
    t = {t.v0 * 0.05f, t.v1 * 0.05f, t.v2 * 0.05f};
    triangles.push_back(t);
  }
  return build_grid_cells(triangles, {GridResolution::Rule::density, 1000});
}

/// Points of triangles, moved by nine tenths of the margin of the scene's cells, lie in cells that list them.
TEST(GridCells, ListTheTrianglesOfTheirPointsMarginIncluded) {
  std::vector<Triangle> triangles;
  const GridCells grid = grid_of_levels(triangles);
  const GridLevel& level = grid.levels.front();
  ASSERT_GT(grid.levels.size(), 1u);
  int found = 0, moved_over = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Sampler random(8, i, 0);
    for (int j = 0; j < 60; ++j) {
      const auto [b1, b2] = uniform_triangle(random.next_2d());
      Vec3d p = (point_at(triangles[i], b1, b2) - level.lo) * level.cells_per_unit;
      const Vec3d before = p;
      p[j % 3] += (j % 2 == 0 ? 0.9 : -0.9) / 256;
      std::array<int, 3> cell{};
      bool same = true, inside = true;
      for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        cell[axis] = static_cast<int>(std::floor(p[k]));
        inside &= cell[axis] >= 0 && cell[axis] < level.counts[axis];
        same &= std::floor(before[k]) == std::floor(p[k]);
      }
      if (!inside) continue;
      ASSERT_TRUE(grid.is_occupied(level, level.index(cell))) << i;
      const GridCells::Record& record = grid.record(level, level.index(cell));
      if (record.count == GridCells::Record::kLevel) continue;
      const auto list = grid.references.begin() + record.begin;
      ASSERT_TRUE(std::find(list, list + record.count, i) != list + record.count) << i;
      ++found, moved_over += same ? 0 : 1;
    }
  }
  EXPECT_GT(found, 40000);
  EXPECT_GT(moved_over, 100);
}

/// In cells so thin that the margin for the rounding of hits is larger than that for the rounding of the
/// walk: points of triangles, moved by nine tenths of it, 2^-15 of the scene, lie in cells that list them.
TEST(GridCells, ListTheTrianglesWithinTheErrorOfHits) {
  std::vector<Triangle> line;
  for (Triangle t : test::random_triangles(300, 0.01f, 9)) {
    for (Vec3* v : {&t.v0, &t.v1, &t.v2}) v->y *= 1e-9f, v->z *= 1e-9f;
    line.push_back(t);
  }
  const GridCells grid = build_grid_cells(line, {GridResolution::Rule::density, 4096});
  const GridLevel& level = grid.levels.front();
  ASSERT_EQ(level.counts[0], 4096);
  int moved_over = 0;
  for (std::uint32_t i = 0; i < line.size(); ++i) {
    for (const Vec3& v : {line[i].v0, line[i].v1, line[i].v2}) {
      for (const double way : {-0.9 * 0x1p-15, 0.9 * 0x1p-15}) {
        const double before = (v.x - level.lo.x) * level.cells_per_unit.x;
        const double place = before + way * (grid.hi.x - grid.lo.x) * level.cells_per_unit.x;
        if (place < 0 || place >= level.counts[0]) continue;
        const auto cell = static_cast<std::uint32_t>(place);
        ASSERT_TRUE(grid.is_occupied(level, cell)) << i;
        const GridCells::Record& record = grid.record(level, cell);
        const auto list = grid.references.begin() + record.begin;
        ASSERT_TRUE(std::find(list, list + record.count, i) != list + record.count) << i;
        moved_over += std::floor(before) != std::floor(place) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(moved_over, 50);
}

/// The part of the list that holds triangle i.
std::size_t part_with(const GridCells& grid, const GridCells::Record& list, std::uint32_t i) {
  const auto begin = grid.references.begin() + list.begin;
  return static_cast<std::size_t>(std::find(begin, begin + list.count, i) - begin) / GridCells::kPart;
}

/// Whether all points within `error` of p on each axis lie in box i of `size` (GridCells::part_boxes).
bool holds(const float* boxes, std::size_t size, std::size_t i, const Vec3d& p, double error) {
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (boxes[axis * size + i] > p[k] - error || boxes[(axis + 3) * size + i] < p[k] + error) return false;
  }
  return true;
}

/// Points of triangles, vertices too, moved by the most that hits err, 2^-15 of the scene, lie in the box of
/// the cell and in those of the part of its list and of the group of parts.
TEST(GridCells, BoxesHoldTheirTriangles) {
  std::vector<Triangle> triangles = test::random_triangles(3000, 0.2f, 4);
  const GridCells grid = build_grid_cells(triangles, {GridResolution::Rule::density, 27});
  const GridLevel& level = grid.levels.front();
  const double error = max_norm(grid.hi - grid.lo) * 0x1p-15;
  int with_parts = 0, with_groups = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Sampler random(8, i, 0);
    for (int j = 0; j < 20; ++j) {
      auto [b1, b2] = uniform_triangle(random.next_2d());
      if (j < 3) b1 = j == 1 ? 1 : 0, b2 = j == 2 ? 1 : 0;
      const Vec3d p = point_at(triangles[i], b1, b2);
      const auto cell = occupied_cell_at(grid, level, p);
      if (!cell) continue;
      const GridCells::Record& record = grid.record(level, *cell);
      ASSERT_NE(record.count, GridCells::Record::kLevel);
      for (int k = 0; k < 3; ++k) {
        ASSERT_LE(record.lo[k], p[k] - error) << i;
        ASSERT_GE(record.hi[k], p[k] + error) << i;
      }
      const std::size_t part = part_with(grid, record, i), groups = GridCells::group_count(record.count);
      if (record.count > GridCells::kFew) {
        ASSERT_TRUE(holds(grid.part_boxes(record), GridCells::part_count(record.count), part, p, error)) << i;
        ++with_parts;
      }
      if (groups > 0) {
        ASSERT_TRUE(holds(grid.group_boxes(record), groups, part / GridCells::kGroup, p, error)) << i;
        ++with_groups;
      }
    }
  }
  EXPECT_GT(with_parts, 10000);
  EXPECT_GT(with_groups, 10000);
}

/// The boxes of a grid's cells lie in that of the cell that holds it.
TEST(GridCells, BoxesOfGridsHoldThoseOfTheirCells) {
  std::vector<Triangle> triangles;
  const GridCells grid = grid_of_levels(triangles);
  const auto inner = std::find_if(grid.records.begin(), grid.records.end(), [](const GridCells::Record& r) {
    return r.count == GridCells::Record::kLevel;
  });
  ASSERT_NE(inner, grid.records.end());
  const GridLevel& level = grid.levels[inner->begin];
  int cells = 0;
  for (std::uint32_t i = 0; i < level.cell_count(); ++i) {
    if (!grid.is_occupied(level, i)) continue;
    const GridCells::Record& part = grid.record(level, i);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(inner->lo[k], part.lo[k]);
      EXPECT_GE(inner->hi[k], part.hi[k]);
    }
    ++cells;
  }
  EXPECT_GT(cells, 50);
}

/// A ball of 60k triangles in one cell that are small against the margin of cells in a box 2000 times as
/// large: lists of a tenth of them at most, and few copies.
TEST(GridCells, ATinyCrowdInALargeBoxComesApart) {
  auto triangles = test::sphere_mesh({30, -40, 24}, 0.1f, 175, 175);
  const std::size_t crowd = triangles.size();
  const auto box = test::inward_box({-100, -100, -100}, {100, 100, 100});
  triangles.insert(triangles.end(), box.begin(), box.end());
  const GridCells grid = build_grid_cells(triangles, {});
  EXPECT_LT(grid.references.size(), 8 * crowd);
  for (const GridCells::Record& record : grid.records) {
    if (record.count == GridCells::Record::kLevel) continue;
    EXPECT_LT(record.count, crowd / 10);
  }
}

/// Steps along rays find no occupied cell that the walk does not visit, whatever the instruction set.
TEST(GridWalk, VisitsTheOccupiedCellsAlongTheRay) {
  std::vector<Triangle> triangles;
  const GridCells grid = grid_of_levels(triangles);
  const GridLevel& level = grid.levels.front();
  std::size_t visits = 0;
  for (const GridTrace& trace : grid_traces()) {
    for (std::uint32_t i = 0; i < 2000; ++i) {
      Sampler random(5, i, 0);
      const Vec3 from = test::random_point(random) * 3.0f - Vec3(1), to = test::random_point(random);
      const Ray ray{from, to - from};
      std::vector<std::uint32_t> cells;
      trace.walk(grid, ray, cells);
      const std::set<std::uint32_t> visited(cells.begin(), cells.end());
      EXPECT_EQ(visited.size(), cells.size()) << "a cell was visited twice";
      visits += visited.size();
      for (double t = 0; t < 3; t += 0.01) {
        const auto cell = occupied_cell_at(grid, level, Vec3d(ray.origin) + Vec3d(ray.direction) * t);
        ASSERT_TRUE(!cell || visited.contains(*cell)) << trace.name;
      }
    }
  }
  EXPECT_GT(visits, 2000u);
}

}  // namespace
}  // namespace lemma
