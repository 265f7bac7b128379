#include "tests/support/meshes.h"

#include <array>
#include <cmath>

#include "src/core/warp.h"

namespace lemma::test {

std::vector<Triangle> sphere_mesh(const Vec3& centre, float radius, int rings, int segments) {
  // Each vertex is computed once per (ring, segment modulo segments): the mesh is closed to the bit.
  const auto vertex = [&](int ring, int segment) {
    if (ring == 0) return centre + Vec3(0, radius, 0);
    if (ring == rings) return centre - Vec3(0, radius, 0);
    const float theta = kPi * static_cast<float>(ring) / static_cast<float>(rings);
    const float phi = 2 * kPi * static_cast<float>(segment % segments) / static_cast<float>(segments);
    return centre +
           Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)) * radius;
  };
  std::vector<Triangle> triangles;
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const Vec3 a = vertex(r, s), b = vertex(r + 1, s), c = vertex(r + 1, s + 1), d = vertex(r, s + 1);
      if (r > 0) triangles.push_back({a, b, d});
      if (r + 1 < rings) triangles.push_back({b, c, d});
    }
  }
  return triangles;
}

std::vector<Triangle> random_triangles(std::size_t count, float size, std::uint64_t seed) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler random(seed, i, 0);
    const Vec3 p = random_point(random);
    const auto corner = [&] { return p + random_direction(random) * (size * random.next()); };
    const Vec3 v0 = corner(), v1 = corner();
    triangles.push_back({v0, v1, corner()});
  }
  return triangles;
}

std::vector<Triangle> inward_box(const Vec3& lo, const Vec3& hi) {
  const auto corner = [&](int i) {
    return Vec3((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
  };
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}};
  const Vec3 centre = (lo + hi) * 0.5f;
  std::vector<Triangle> triangles;
  for (const auto& f : faces) {
    for (const Triangle& t : {Triangle{corner(f[0]), corner(f[1]), corner(f[2])},
                              Triangle{corner(f[0]), corner(f[2]), corner(f[3])}}) {
      const bool inward = dot(geometric_normal(t), centre - t.v0) > 0;
      triangles.push_back(inward ? t : Triangle{t.v0, t.v2, t.v1});
    }
  }
  return triangles;
}

Vec3 random_direction(Sampler& random) {
  const float z = 1 - 2 * random.next();
  const float phi = 2 * kPi * random.next();
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Vec3 random_point(Sampler& random) {
  const float x = random.next(), y = random.next();
  return {x, y, random.next()};
}

}  // namespace lemma::test
