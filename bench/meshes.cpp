#include "bench/meshes.h"

#include <array>

#include "src/core/warp.h"

namespace lemma::bench {
namespace {

using Mesh = std::vector<Triangle>;

/// The surface p(u, v), u and v in [0, 1], as columns x rows quadrangles of two triangles.
template <class Surface>
void add_surface(const Surface& p, int columns, int rows, Mesh& mesh) {
  const auto point = [&](int i, int j) {
    return p(static_cast<float>(i) / static_cast<float>(columns),
             static_cast<float>(j) / static_cast<float>(rows));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec3 a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
      mesh.push_back({a, b, c});
      mesh.push_back({a, c, d});
    }
  }
}

void add_box(const Vec3& lo, const Vec3& hi, Mesh& mesh) {
  const auto corner = [&](int i) {
    return Vec3((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
  };
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}};
  for (const auto& f : faces) {
    mesh.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    mesh.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
}

/// A solid of revolution about the vertical through `foot`: radius(v) at height v * height.
template <class Radius>
void add_turned(const Vec3& foot, float height, const Radius& radius, int columns, int rows, Mesh& mesh) {
  const auto p = [&](float u, float v) {
    const float phi = 2 * kPi * u;
    return foot + Vec3(radius(v) * std::cos(phi), v * height, radius(v) * std::sin(phi));
  };
  add_surface(p, columns, rows, mesh);
}

/// The smallest n with factor * n * n >= count.
int side_for(std::size_t count, double factor) {
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count) / factor)));
}

}  // namespace

Mesh displaced_sphere_in_box(std::size_t count) {
  Mesh mesh;
  add_box(Vec3(-2), Vec3(2), mesh);
  const auto p = [](float u, float v) {
    const float phi = 2 * kPi * u, theta = kPi * v;
    const float r = 1 + 0.05f * std::sin(9 * phi) * std::sin(11 * theta) +
                    0.005f * std::sin(70 * phi) * std::sin(83 * theta);
    return Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)) * r;
  };
  const int rows = side_for(count, 4);  // two triangles a quadrangle, twice as many columns as rows
  add_surface(p, 2 * rows, rows, mesh);
  return mesh;
}

Mesh height_field(std::size_t count) {
  Mesh mesh;
  const auto p = [](float u, float v) {
    const float x = 2 * u - 1, z = 2 * v - 1;
    return Vec3(x,
                0.15f * std::sin(5 * x + 1) * std::cos(4 * z) + 0.02f * std::sin(31 * x) * std::sin(37 * z) +
                    0.003f * std::sin(171 * x + 90 * z),
                z);
  };
  const int side = side_for(count, 2);
  add_surface(p, side, side, mesh);
  return mesh;
}

Mesh interior() {
  Mesh mesh;
  add_box({0, 0, 0}, {12, 5, 8}, mesh);
  const auto column = [](float v) { return 0.3f - 0.05f * v; };
  const auto vase = [](float v) { return 0.04f + 0.12f * std::sin(kPi * (0.15f + 0.75f * v)); };
  for (int i = 0; i < 6; ++i) {
    const float x = 1 + 2 * static_cast<float>(i);
    for (const float z : {1.0f, 7.0f}) add_turned({x, 0, z}, 5, column, 32, 8, mesh);
    add_box({x - 0.6f, 0.7f, 3.2f}, {x + 0.6f, 0.75f, 4.8f}, mesh);
    for (const float dx : {-0.5f, 0.5f}) {
      for (const float z : {3.3f, 4.7f}) {
        add_box({x + dx - 0.03f, 0, z - 0.03f}, {x + dx + 0.03f, 0.7f, z + 0.03f}, mesh);
      }
    }
    add_turned({x, 0.75f, 4}, 0.5f, vase, 64, 32, mesh);
  }
  return mesh;
}

Mesh lamp(const Vec3& centre, float half_width) {
  Mesh mesh;
  const auto p = [&](float u, float v) { return centre + Vec3(2 * u - 1, 0, 2 * v - 1) * half_width; };
  add_surface(p, 1, 1, mesh);
  return mesh;
}

}  // namespace lemma::bench
