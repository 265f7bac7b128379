#include <cmath>
#include <cstdio>
#include <numbers>

#include "src/core/alias_table.h"
#include "src/core/frame.h"
#include "src/core/warp.h"
#include "src/lights/emitter_weights.h"
#include "src/lights/light_tree.h"
#include "src/lights/projected_triangle.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/triangle_sampling.h"
#include "tests/hard/hard_case.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"
#include "tests/support/seen_triangles.h"
#include "tests/support/statistics.h"

namespace lemma::test {
namespace {

constexpr double kPi2 = 2 * std::numbers::pi;

/// Counts a fault unless the statement is true, and says of what.
void expect(bool statement, std::string_view of, double value, Outcome& outcome) {
  ++outcome.rays;
  if (statement) return;
  ++outcome.faults;
  std::printf("fault: %.*s %.17g\n", static_cast<int>(of.size()), of.data(), value);
}

/// Triangles of all sizes from 1e-6 to 1e3 at random, about 1 away.
std::vector<SeenTriangle> random_seen_triangles(std::uint32_t count) {
  std::vector<SeenTriangle> cases;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler random(91, i, 0);
    const Vec3 middle = random_direction(random);
    const float size = std::pow(10.0f, -6 + 9 * random.next());
    const auto corner = [&] { return middle + random_direction(random) * size; };
    const Vec3 v0 = corner(), v1 = corner();
    cases.push_back({"random", {v0, v1, corner()}, Vec3(0), random_direction(random)});
  }
  return cases;
}

/// How far the rounding of a triangle's normal and of its distance from x in double can move its solid angle,
/// relative: what is left of the volume's digits, and 16 operations.
double rounding(const SeenTriangle& seen) {
  const Triangle& t = seen.triangle;
  const Vec3d a = Vec3d(t.v0) - Vec3d(seen.x);
  const Vec3d e1 = Vec3d(t.v1) - Vec3d(t.v0), e2 = Vec3d(t.v2) - Vec3d(t.v0);
  return 16 * 0x1p-53 * (1 + length(a) * length(e1) * length(e2) / std::abs(side_of(t, seen.x)));
}

/// 15: solid angles from 1e-12 to nearly a hemisphere against 50 digits.
Outcome solid_angle_ladder(std::string_view) {
  Outcome outcome;
  auto cases = hard_triangles();
  for (const SeenTriangle& seen : random_seen_triangles(2000)) cases.push_back(seen);
  for (const SeenTriangle& seen : cases) {
    const double exact = exact_solid_angle(corners(seen.triangle), seen.x);
    const double error = SphericalTriangle(seen.triangle, seen.x).solid_angle() / exact - 1;
    expect(std::abs(error) <= rounding(seen), seen.name, error, outcome);
  }
  return outcome;
}

/// 16: a closed mesh covers 4 pi from inside and, with signs, 0 from outside. The sum of 2 n angles errs by
/// less than their number of roundings.
Outcome closed_meshes(std::string_view) {
  Outcome outcome;
  for (const int rings : {6, 20, 60}) {
    const auto mesh = sphere_mesh({1, 2, 3}, 1, rings, rings);
    for (std::uint32_t i = 0; i < 40; ++i) {
      Sampler random(92, i, 0);
      const bool inside = i % 2 == 0;
      const Vec3 x = Vec3(1, 2, 3) + random_direction(random) * (inside ? 0.7f : 1.1f + 5 * random.next());
      double sum = 0;
      for (const Triangle& t : mesh) {
        sum += std::copysign(SphericalTriangle(t, x).solid_angle(), side_of(t, x));
      }
      const double error = std::abs(sum) - (inside ? 2 * kPi2 : 0);
      expect(std::abs(error) < 1e-11, inside ? "inside" : "outside", error, outcome);
    }
  }
  return outcome;
}

/// A sampler of a triangle's directions.
using DirectionSampler = Vec3d (*)(const SeenTriangle& seen, const Vec2& u);

Vec3d sample_uniformly(const SeenTriangle& seen, const Vec2& u) {
  const SphericalTriangle triangle(seen.triangle, seen.x);
  return normalize(sample_triangle(seen.triangle, triangle, seen.x, u) - Vec3d(seen.x));
}

Vec3d sample_by_cosine(const SeenTriangle& seen, const Vec2& u) {
  const ProjectedTriangle triangle(seen.triangle, seen.x, seen.n);
  return triangle.sample(u);
}

/// Directions in parts of the triangle of known measure: chi-square, each triangle at a significance such
/// that all of them together have 1 % (Sidak); and none may lie outside. Triangles of other measures are
/// drawn by area, and are named.
Outcome histograms(DirectionSampler sample, Partition::Measure measure, double smallest, double largest) {
  constexpr std::uint32_t draws = 60000;
  Outcome outcome;
  const auto& cases = hard_triangles();
  const double significance = -std::expm1(std::log1p(-0.01) / static_cast<double>(cases.size()));
  for (const SeenTriangle& seen : cases) {
    const Partition partition(seen, measure, 150);
    if (partition.total() < smallest || partition.total() > largest) {
      std::printf("by area: %.*s\n", static_cast<int>(seen.name.size()), seen.name.data());
      continue;
    }
    std::vector<double> counts(partition.shares().size(), 0.0);
    int outside = 0;
    Sampler random(93, 0, 0);
    for (std::uint32_t i = 0; i < draws; ++i) {
      const int part = partition.part_seen(sample(seen, random.next_2d()));
      part < 0 ? void(++outside) : void(++counts[static_cast<std::size_t>(part)]);
    }
    const double tail = chi_square_test(counts, partition.shares());
    expect(outside == 0, seen.name, outside, outcome);
    expect(tail > significance, seen.name, tail, outcome);
  }
  return outcome;
}

/// 17
Outcome spherical_triangle_histograms(std::string_view) {
  return histograms(sample_uniformly, solid_angle_of, 0, kPi2 * (1 - 1e-5));
}

/// 18
Outcome projected_triangle_histograms(std::string_view) {
  return histograms(sample_by_cosine, projected_solid_angle_of, 1e-9, kPi2);
}

/// 18: the projected solid angle against 50 digits, and samples above the horizon and within the triangle.
/// With them and a density cos / P the irradiance has no variance. P is a sum of at most 8 differences of
/// areas below pi / 2, each good to 16 roundings over the rounding of the edges' planes.
Outcome projected_solid_angles(std::string_view) {
  Outcome outcome;
  auto cases = hard_triangles();
  for (const SeenTriangle& seen : random_seen_triangles(2000)) cases.push_back(seen);
  for (const SeenTriangle& seen : cases) {
    const ProjectedTriangle triangle(seen.triangle, seen.x, seen.n);
    const double exact = exact_projected_solid_angle(corners(seen.triangle), seen.x, seen.n);
    const double error = triangle.projected_solid_angle() - exact;
    expect(std::abs(error) <= 8 * 32 * 0x1p-53 + rounding(seen) * exact, seen.name, error, outcome);
    if (!triangle.can_be_sampled()) continue;
    Sampler random(94, 0, 0);
    for (int i = 0; i < 20; ++i) {
      const double cosine = dot(triangle.sample(random.next_2d()), normalize(Vec3d(seen.n)));
      expect(cosine >= 0, seen.name, cosine, outcome);
    }
  }
  return outcome;
}

/// 24: the ends of the range of every number that a light sampler draws.
Outcome extremes_of_u(std::string_view) {
  Outcome outcome;
  constexpr float last = 1 - 0x1p-24f;
  constexpr double last_choice = 0xFFFFFFFFu * 0x1p-32;
  const auto check = [&](const Vec3d& w, std::string_view of) {
    expect(std::abs(length(w) - 1) <= 4 * 0x1p-53, of, length(w) - 1, outcome);
  };
  for (const float u : {0.0f, last}) {
    for (const float v : {0.0f, last, 0.5f}) {
      for (const SeenTriangle& seen : hard_triangles()) {
        check(sample_uniformly(seen, {u, v}), seen.name);
        const Partition whole(seen, solid_angle_of, 1);
        expect(whole.part_seen(sample_uniformly(seen, {u, v})) == 0, seen.name, -1, outcome);
        if (projected_solid_angle_of(corners(seen.triangle), seen) < 2e-9) continue;
        check(sample_by_cosine(seen, {u, v}), seen.name);
        expect(whole.part_seen(sample_by_cosine(seen, {u, v})) == 0, seen.name, -1, outcome);
      }
      for (const double radius : {1e-9, 0.3, 0.985}) {
        check(SphereCone({0, 0.6, -0.8}, radius, {0, 0, 0}).sample({u, v}), "cone");
      }
    }
  }
  const auto emitters = two_spheres();
  const LightTree tree(emitters, {});
  for (const auto measure :
       {EmitterWeights::Measure::solid_angle, EmitterWeights::Measure::projected_solid_angle}) {
    const EmitterWeights weights(emitters, measure);
    for (std::uint32_t i = 0; i < 200; ++i) {
      Sampler random(95, i, 0);
      const Vec3 x = random_point(random) * 3;
      LightQuery at{x, random_direction(random)};
      weights.prepare(at);
      for (const double u : {0.0, last_choice}) {
        const auto choice = weights.choose(at, u);
        expect(!choice || (choice->emitter < emitters.size() && choice->pmf > 0), "choice", u, outcome);
        const auto light = tree.choose(at, u);
        expect(!light || light->pmf > 0, "tree", u, outcome);
      }
    }
  }
  std::vector<double> some_zero{0, 1, 0, 3, 0};
  const AliasTable table(some_zero);
  for (const std::uint32_t bits : {0u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
    expect(some_zero[table.sample(bits)] > 0, "alias table", bits, outcome);
  }
  return outcome;
}

}  // namespace

std::span<const HardCase> sampling_cases() {
  static constexpr HardCase cases[] = {
      {"15 solid angles 1e-12 to 2 pi", "50 digits", solid_angle_ladder},
      {"16 closed meshes", "4 pi or 0", closed_meshes},
      {"17 uniform over triangles", "chi-square at 1 %", spherical_triangle_histograms},
      {"18 by cosine over triangles", "chi-square at 1 %", projected_triangle_histograms},
      {"18 projected solid angles", "50 digits", projected_solid_angles},
      {"24 extremes of random numbers", "directions, choices", extremes_of_u}};
  return cases;
}

}  // namespace lemma::test
