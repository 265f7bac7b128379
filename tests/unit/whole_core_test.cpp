// Rays that pass the core of a whole light: what is known of them without tracing is what tracing finds.
#include "src/lights/whole_core.h"

#include <gtest/gtest.h>

#include <cmath>

#include "accel/accelerator.h"
#include "src/lights/light_sampler.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A closed body, star-shaped about its centre, with dents that some rays enter at grazing angles.
std::vector<Triangle> dented_sphere(const Vec3& centre, float radius) {
  auto mesh = test::sphere_mesh({0, 0, 0}, 1, 12, 16);
  for (Triangle& t : mesh) {
    for (Vec3* v : {&t.v0, &t.v1, &t.v2}) {
      const float height = 1 + 0.06f * std::sin(7 * v->x) * std::sin(5 * v->y + 1) * std::sin(6 * v->z + 2);
      *v = centre + *v * (radius * height);
    }
  }
  return mesh;
}

struct Body {
  const char* name;
  std::vector<Triangle> triangles;
};

std::vector<Body> bodies() {
  return {{"coarse", test::sphere_mesh({1, 2, 3}, 0.5f, 6, 8)},
          {"fine", test::sphere_mesh({1, 2, 3}, 0.5f, 24, 32)},
          {"small and far from the origin", test::sphere_mesh({100, -200, 50}, 0.02f, 12, 16)},
          {"dented", dented_sphere({-3, 0, 2}, 2)}};
}

WholeLight whole_of(const std::vector<Triangle>& body, std::span<const Triangle> scene) {
  return find_whole_lights(test::emitters_of(body, 1, 0), scene).at(0);
}

/// Small triangles about a light, beyond what must be clear, up to 4 radii away.
void add_obstacles(const WholeLight& light, int count, Sampler& random, std::vector<Triangle>& scene) {
  for (int i = 0; i < count; ++i) {
    const auto size = static_cast<float>(0.3 * light.radius);
    const double distance = light.radius * (1.4 + 2.6 * random.next());
    const Vec3 at(light.centre + Vec3d(test::random_direction(random)) * distance);
    scene.push_back(
        {at, at + test::random_direction(random) * size, at + test::random_direction(random) * size});
  }
}

/// A point from 1.0103 radii, where lights begin to be sampled as wholes, up to where no core is.
Vec3 random_viewpoint(const WholeLight& light, Sampler& random) {
  const double distance = 1.0103 * light.radius * std::pow(900.0, double{random.next()});
  return Vec3(light.centre + Vec3d(test::random_direction(random)) * distance);
}

/// A direction from x that passes the centre by at most `radius`.
Vec3 direction_near(const Vec3d& centre, double radius, const Vec3& x, Sampler& random) {
  const Vec3d near =
      centre + Vec3d(test::random_direction(random)) * (radius * std::cbrt(double{random.next()}));
  return Vec3(normalize(near - Vec3d(x)));
}

class WholeCoreTest : public ::testing::TestWithParam<std::string_view> {
 protected:
  static std::unique_ptr<const Accelerator> build(std::span<const Triangle> triangles) {
    return find_named(accelerators(), GetParam()).value()(triangles, {});
  }
};

TEST_P(WholeCoreTest, ARayThroughItSeesTheLightUnlessBlockedBeforeTheShell) {
  for (const auto& [name, body] : bodies()) {
    Sampler random(61, 0, 0);
    std::vector<Triangle> scene = body;
    add_obstacles(whole_of(body, body), 150, random, scene);
    const WholeLight light = whole_of(body, scene);
    ASSERT_GT(light.core, 0.5 * light.radius) << name;
    const auto emitters = test::emitters_of(body, 1, 0);
    const auto accel = build(scene);
    int seen = 0, hidden = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 x = random_viewpoint(light, random);
      const Vec3 w = direction_near(light.centre, light.radius, x, random);
      const float until = WholeCore{light.centre, light.core, light.shell}.visible_until(x, w);
      if (until == kInfinity) continue;
      const auto hit = accel->closest_hit({x, w});
      ASSERT_TRUE(hit) << name;
      const bool is_seen = hit->triangle < body.size() && emits_towards(emitters[hit->triangle], x);
      ASSERT_EQ(is_seen, !accel->occluded({x, w, 0, until})) << name << ", ray " << i;
      ++(is_seen ? seen : hidden);
    }
    EXPECT_GT(seen, 2000) << name;
    EXPECT_GT(hidden, 500) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, WholeCoreTest, ::testing::Values("grid", "embree", "brute"),
                         [](const auto& test) { return std::string(test.param); });

TEST(WholeCore, IsNoneWhereAnythingElseComesNear) {
  const auto body = test::sphere_mesh({1, 2, 3}, 0.5f, 12, 16);
  const auto light_beside = [&](const Triangle& other) {
    std::vector<Triangle> scene = body;
    scene.push_back(other);
    return whole_of(body, scene);
  };
  const auto core_beside = [&](const Triangle& other) { return light_beside(other).core; };
  const auto floor_at = [](float y) { return Triangle{{-9, y, -9}, {9, y, -9}, {0, y, 20}}; };
  EXPECT_GT(core_beside(floor_at(2 - 0.52f)), 0);
  EXPECT_NEAR(light_beside(floor_at(0)).shell, 2 / WholeCore::kClear, 1e-6);
  EXPECT_EQ(core_beside(floor_at(2 - 0.505f)), 0);
  EXPECT_EQ(core_beside(floor_at(2)), 0);
  const float tilt = 0.52f * std::sqrt(2.0f);  // the distance of a plane x + y = const, along an axis
  EXPECT_GT(core_beside({{1 + tilt, 2, -9}, {1, 2 + tilt, -9}, {1 + tilt / 2, 2 + tilt / 2, 20}}), 0);
  EXPECT_EQ(core_beside({{1.2f, 2.2f, 3}, {1.3f, 2.2f, 3}, {1.2f, 2.3f, 3}}), 0);  // within
}

/// From farther away rounding may move a ray past the body.
TEST(WholeCore, EndsWithDistance) {
  const WholeCore core{{0, 0, 0}, 1, 1.0302};
  EXPECT_NEAR(core.visible_until({0, 0, -990}, {0, 0, 1}), 990 - 1.0302, 1e-4);
  EXPECT_EQ(core.visible_until({0, 0, -1001}, {0, 0, 1}), kInfinity);
  const auto aside = [](float x) { return Vec3(Vec3d(x, 0, 10) * (1 / std::hypot(x, 10.0f))); };
  EXPECT_LT(core.visible_until({0, 0, -10}, aside(0.99f)), 10);
  EXPECT_EQ(core.visible_until({0, 0, -10}, aside(1.01f)), kInfinity);
  EXPECT_EQ(core.visible_until({0, 0, -1.02f}, {0, 0, 1}), 0);  // within the shell, which is empty
}

}  // namespace
}  // namespace lemma
