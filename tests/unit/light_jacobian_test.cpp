// Directions towards triangles and cones: 1 / density is the area that a step of u sweeps over on the sphere.
#include <gtest/gtest.h>

#include <cmath>

#include "src/lights/projected_triangle.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/triangle_sampling.h"
#include "tests/support/seen_triangles.h"

namespace lemma {
namespace {

// Densities of the area are in float32: three roundings.
constexpr double kDensityError = 3 * 0x1p-24;

struct Jacobian {
  double value;     // |dw/du x dw/dv| [sr]
  double rounding;  // it may err by, relative: directions by 2^-50, divided by the step
};

/// By central differences over 2 h.
template <class Map>
Jacobian jacobian(const Map& direction, const Vec2& u, float h) {
  const Vec3d a = (direction({u.x + h, u.y}) - direction({u.x - h, u.y})) * (0.5 / double{h});
  const Vec3d b = (direction({u.x, u.y + h}) - direction({u.x, u.y - h})) * (0.5 / double{h});
  const double value = length(cross(a, b));
  return {value, 0x1p-50 * (length(a) + length(b)) / (double{h} * value)};
}

/// Counts the points at which the difference of two steps, which is three times what the smaller one errs by,
/// says that differences are worth anything: not where a sector of a polygon ends between them.
template <class Map, class Density>
int expect_inverse_of_density(const Map& direction, const Density& density, std::string_view name) {
  int checked = 0;
  for (const float u : {0.0625f, 0.25f, 0.5f, 0.71875f, 0.9375f}) {
    for (const float v : {0.0625f, 0.25f, 0.5f, 0.71875f, 0.9375f}) {
      const Jacobian coarse = jacobian(direction, {u, v}, 0x1p-9f),
                     fine = jacobian(direction, {u, v}, 0x1p-10f);
      const double tolerance = std::abs(coarse.value / fine.value - 1) + coarse.rounding + fine.rounding;
      if (!(tolerance < 1e-2)) continue;
      ++checked;
      EXPECT_NEAR(fine.value * density(direction({u, v})), 1, tolerance + kDensityError)
          << name << " " << u << " " << v;
    }
  }
  return checked;
}

TEST(LightJacobian, UniformOverTheSolidAngle) {
  int checked = 0;
  for (const test::SeenTriangle& seen : test::hard_triangles()) {
    const SphericalTriangle triangle(seen.triangle, seen.x);
    if (!triangle.can_be_sampled()) continue;
    checked += expect_inverse_of_density([&](const Vec2& u) { return triangle.sample(u); },
                                         [&](const Vec3d&) { return 1 / triangle.solid_angle(); }, seen.name);
  }
  EXPECT_GT(checked, 150);
}

TEST(LightJacobian, ByTheCosine) {
  int checked = 0;
  for (const test::SeenTriangle& seen : test::hard_triangles()) {
    const ProjectedTriangle triangle(seen.triangle, seen.x, seen.n);
    if (!triangle.can_be_sampled()) continue;
    const auto density = [&](const Vec3d& w) {
      return dot(w, Vec3d(seen.n)) / triangle.projected_solid_angle();
    };
    checked +=
        expect_inverse_of_density([&](const Vec2& u) { return triangle.sample(u); }, density, seen.name);
  }
  EXPECT_GT(checked, 150);
}

TEST(LightJacobian, UniformOverAConeAndOverTheArea) {
  const Vec3 x(0.2f, -0.4f, 0.1f);
  for (const double radius : {1e-4, 0.3, 0.9}) {
    const SphereCone cone({0, 0.6, -0.8}, radius, x);
    EXPECT_GT(expect_inverse_of_density([&](const Vec2& u) { return cone.sample(u); },
                                        [&](const Vec3d&) { return 1 / cone.solid_angle(); }, "cone"),
              20);
  }
  const Emitter emitter{.shape = {{1, 0, 0}, {0, 0.5f, 1}, {-1, 1, 0.2f}}, .radiance = {1, 1, 1}};
  const Vec3 below = side_of(emitter.shape, x) > 0 ? x : Vec3(0.3f, 2, 1);
  const auto direction = [&](const Vec2& u) {
    return normalize(sample_area(emitter.shape, u) - Vec3d(below));
  };
  const auto density = [&](const Vec3d& w) {
    const auto connection = connect(emitter, below, point_seen(emitter.shape, below, w));
    return connection ? double{area_pdf(1, emitter.shape, *connection).value} : 0.0;
  };
  EXPECT_GT(expect_inverse_of_density(direction, density, "area"), 20);
}

}  // namespace
}  // namespace lemma
