#include "src/lights/body_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/lights/body_trace.h"
#include "src/lights/sphere_cone.h"
#include "tests/support/lights.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

/// The nearest emitter of a body along a ray, by the exact signs that double gives for all but edges.
std::optional<std::uint32_t> nearest(const std::vector<Emitter>& emitters, const Vec3& x, const Vec3d& w) {
  double best = std::numeric_limits<double>::infinity();
  std::optional<std::uint32_t> found;
  for (std::uint32_t e = 0; e < emitters.size(); ++e) {
    const Triangle& t = emitters[e].shape;
    const Vec3d a = Vec3d(t.v0) - Vec3d(x), b = Vec3d(t.v1) - Vec3d(x), c = Vec3d(t.v2) - Vec3d(x);
    const double at_a = dot(w, cross(b, c)), at_b = dot(w, cross(c, a)), at_c = dot(w, cross(a, b));
    if ((at_a < 0 || at_b < 0 || at_c < 0) && (at_a > 0 || at_b > 0 || at_c > 0)) continue;
    const double distance = dot((a * at_a + b * at_b + c * at_c) * (1 / (at_a + at_b + at_c)), w);
    if (distance < best) best = distance, found = e;
  }
  return found;
}

/// Whether both ways to find a point, the walk into a convex body and the hierarchy, say the same.
void expect_same_point(const std::optional<BodyMesh::Point>& a, const std::optional<BodyMesh::Point>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->emitter, b->emitter);
  EXPECT_EQ(a->y, b->y);
}

/// Round bodies of few and many triangles, one of them dented, from close by and from far away: every
/// instruction set finds what looking at all triangles finds.
TEST(BodyMesh, FindsTheNearestEmitterOnEveryInstructionSet) {
  for (const BodyTrace& set : body_traces()) {
    std::printf("%s\n", set.name);
    for (const int rings : {3, 6, 20, 40}) {
      auto mesh = test::sphere_mesh({100, -50, 7}, 0.25f, rings, 2 * rings);
      if (rings == 20) {
        for (Triangle& t : mesh) {
          for (Vec3* v : {&t.v0, &t.v1, &t.v2}) v->y += 0.2f * std::sin(12 * v->x) * (v->x - 100);
        }
      }
      const auto emitters = test::emitters_of(mesh, 1, 0);
      const auto lights = find_whole_lights(emitters);
      ASSERT_EQ(lights.size(), rings == 3 ? 0u : 1u);
      if (lights.empty()) continue;
      const BodyMesh body(emitters, lights.front());
      ASSERT_EQ(body.walk.has_value(), rings != 20) << "the dented one is not convex";
      int hits = 0, walked = 0;
      for (std::uint32_t i = 0; i < 400; ++i) {
        Sampler random(111, i, 0);
        const auto distance = static_cast<float>(1.02 * body.radius * std::pow(10.0, 5 * random.next()));
        const Vec3 x = Vec3(body.centre) + test::random_direction(random) * distance;
        const Vec3d w = SphereCone(body.centre, body.radius, x).sample(random.next_2d());
        const auto found = set.first_hit(body, x, w);
        const auto expected = nearest(emitters, x, w);
        ASSERT_EQ(found.has_value(), expected.has_value()) << i;
        expect_same_point(body.first_hit(x, w), found);
        if (!found) continue;
        ASSERT_EQ(found->emitter, *expected) << i;
        // Coordinates up to 10^5 in double, and some operations on them.
        ASSERT_LT(length(cross(found->y - Vec3d(x), w)), 1e-14 * (distance + 200));
        ++hits;
        walked += body.walk && body.walk->enter(emitters, x, w) ? 1 : 0;
      }
      EXPECT_GT(hits, 150);
      // The walk may give up, at the silhouette; if it did so often it would be of no use.
      if (body.walk) {
        EXPECT_GT(walked, 0.9 * hits);
      }
    }
  }
}

}  // namespace
}  // namespace lemma
