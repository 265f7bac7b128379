#include <cmath>

#include "src/oracle/exact.h"
#include "tests/hard/hard_case.h"
#include "tests/support/meshes.h"

namespace lemma::test {
namespace {

std::vector<Triangle> transformed(std::vector<Triangle> triangles, float scale, const Vec3& shift) {
  for (Triangle& t : triangles) {
    for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v * scale + shift;
  }
  return triangles;
}

/// The same triangles with their first vertex moved on by their index: neighbours see an edge in other
/// places.
std::vector<Triangle> with_rotated_vertices(std::vector<Triangle> triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [a, b, c] = triangles[i];
    if (i % 3 == 1) triangles[i] = {b, c, a};
    if (i % 3 == 2) triangles[i] = {c, a, b};
  }
  return triangles;
}

/// A flat square of 2 n^2 triangles whose vertices are whole numbers from 0 to n, in the plane `axis` = 0.
std::vector<Triangle> lattice(int n, int axis) {
  const auto vertex = [&](int i, int j) {
    Vec3 v(0);
    v[(axis + 1) % 3] = static_cast<float>(i);
    v[(axis + 2) % 3] = static_cast<float>(j);
    return v;
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return triangles;
}

void append(std::vector<Triangle>& to, const std::vector<Triangle>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// 1: rays from inside a closed sphere to all vertices and edge midpoints; those without a hit.
Outcome leaks_of_a_sphere(std::string_view backend) {
  Outcome outcome;
  for (const float shift : {0.0f, 100.0f, 1e4f}) {
    const Vec3 centre(shift, 0, 0);
    const auto mesh = with_rotated_vertices(sphere_mesh(centre, 1, 24, 24));
    const auto accel = make_backend(backend, mesh);
    for (const Triangle& t : mesh) {
      for (const Vec3& target : {t.v0, t.v1, t.v2, (t.v0 + t.v1) * 0.5f, (t.v1 + t.v2) * 0.5f}) {
        const Vec3 from = centre + Vec3(0.125f, 0.25f, -0.125f);
        ++outcome.rays;
        outcome.faults += accel->closest_hit({from, target - from}) ? 0 : 1;
      }
    }
  }
  return outcome;
}

/// 2: random triangles, small to large, and rays of all kinds.
Outcome random_triangles_of_all_sizes(std::string_view backend) {
  std::vector<Triangle> triangles = random_triangles(700, 0.03f, 62);
  append(triangles, random_triangles(250, 0.3f, 63));
  append(triangles, random_triangles(50, 2, 64));
  return judge(backend, triangles, rays_of_all_kinds(triangles, 8000));
}

/// 3: a tessellation on whole numbers, as a grid with aligned cells sees it, seen along its own planes.
Outcome whole_number_lattices(std::string_view backend) {
  std::vector<Triangle> triangles;
  for (const int axis : {0, 1, 2}) append(triangles, lattice(8, axis));
  std::vector<Ray> rays = rays_of_all_kinds(triangles, 8000);
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 8; ++j) {
      const auto x = static_cast<float>(i), y = static_cast<float>(j);
      rays.push_back({{x, y, 9}, {0.0f, -0.0f, -1}});
      rays.push_back({{-1, x, y}, {1, -0.0f, 0.0f}});
      rays.push_back({{x, 9, y}, {-0.0f, -1, -0.0f}});
      rays.push_back({{9, 9, 9}, {x - 9, y - 9, -9}});
    }
  }
  return judge(backend, triangles, rays);
}

/// 4: a box whose walls are the scene's bounding planes, seen from within: rays that see nothing.
Outcome walls_on_the_bounding_box(std::string_view backend) {
  const auto box = inward_box({0, 0, 0}, {7, 5, 3});
  const auto accel = make_backend(backend, box);
  Outcome outcome{.rays = 100000};
  for (std::uint32_t i = 0; i < outcome.rays; ++i) {
    Sampler random(65, i, 0);
    const Ray ray{{3.3f, 2.1f, 1.7f}, random_direction(random)};
    outcome.faults += accel->closest_hit(ray) && accel->occluded(ray) ? 0 : 1;
  }
  return outcome;
}

/// 5: rays that start on, enter at, or run through corners of cells, inside and outside of the grid.
Outcome starts_and_ties_of_the_walk(std::string_view backend) {
  auto triangles = random_triangles(512, 0.2f, 66);
  append(triangles, inward_box({0, 0, 0}, {1, 1, 1}));
  std::vector<Ray> rays;
  for (int i = -4; i <= 20; ++i) {
    for (int j = -4; j <= 20; ++j) {
      const Vec3 corner(static_cast<float>(i) / 16, static_cast<float>(j) / 16, static_cast<float>(i) / 16);
      for (const Vec3& d : {Vec3(1, 1, 1), Vec3(-1, 1, 1), Vec3(1, -1, 0), Vec3(0, 0, -1), Vec3(0, 1, 0)}) {
        rays.push_back({corner, d});
      }
    }
  }
  return judge(backend, triangles, rays);
}

/// 6: a row of 1024 cells with a triangle each that rays pass by until the last.
Outcome a_thousand_cells_in_a_row(std::string_view backend) {
  std::vector<Triangle> row;
  for (int i = 0; i < 1024; ++i) {
    const auto x = static_cast<float>(i);
    row.push_back({{x, 0, 0}, {x, 1, 0}, {x, 0, 1}});
  }
  row.push_back({{1025, -1, -1}, {1025, 9, -1}, {1025, -1, 9}});
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Sampler random(67, i, 0);
    const float y = 0.5f + random.next() * 0.5f;
    rays.push_back({{-3, y, 1.5f - y}, {1, (0.9f - y) / 1028, 0}});
    rays.push_back({{-3, random.next(), random.next()}, {1, 0, 0}});
  }
  return judge(backend, row, rays);
}

/// 7: scenes flat in one axis and in two, and of one triangle, of which one is all but a point.
Outcome flat_scenes(std::string_view backend) {
  Outcome outcome;
  std::vector<std::vector<Triangle>> scenes;
  for (const int axis : {0, 1, 2}) scenes.push_back(lattice(8, axis));
  std::vector<Triangle> needle;
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i);
    needle.push_back({{x, 0, 0}, {x + 1, 0, 0}, {x + 0.5f, 0x1p-20f, 0}});
  }
  scenes.push_back(needle);
  scenes.push_back({{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}});
  scenes.push_back({{{1, 1, 1}, {1.0000001f, 1, 1}, {1, 1.0000001f, 1}}});
  for (const auto& scene : scenes) {
    const Outcome part = judge(backend, scene, rays_of_all_kinds(scene, 2000));
    outcome.rays += part.rays, outcome.faults += part.faults;
  }
  return outcome;
}

/// 8: a sphere of 30k triangles and radius 0.1 in a box of 200.
Outcome teapot_in_a_stadium(std::string_view backend) {
  auto triangles = sphere_mesh({30, -40, 20}, 0.1f, 123, 123);
  append(triangles, inward_box({-100, -100, -100}, {100, 100, 100}));
  return judge(backend, triangles, rays_of_all_kinds(triangles, 1000));
}

/// 9: far from the origin coordinates are coarse, and the triangles are what rounding made of them.
Outcome huge_offsets(std::string_view backend) {
  Outcome outcome;
  for (const float offset : {1e4f, 1e6f, 1e7f}) {
    const auto mesh = transformed(sphere_mesh({0, 0, 0}, 20, 12, 12), 1, Vec3(offset, -offset, offset));
    std::vector<Triangle> kept;
    for (const Triangle& t : mesh) {
      if (area_vector(t) != Vec3d(0)) kept.push_back(t);
    }
    const Outcome part = judge(backend, kept, rays_of_all_kinds(kept, 4000));
    outcome.rays += part.rays, outcome.faults += part.faults;
  }
  return outcome;
}

/// 10: everything by a power of two: the same triangles are hit, at t times the same power, to the bit.
Outcome scales(std::string_view backend) {
  const auto mesh = sphere_mesh({0.5f, 0.25f, 1}, 1, 16, 16);
  const auto accel = make_backend(backend, mesh);
  const std::vector<Ray> rays = rays_of_all_kinds(mesh, 2000);
  Outcome outcome;
  for (const float scale : {0x1p-20f, 0x1p-10f, 0x1p10f, 0x1p20f}) {
    const auto scaled_mesh = transformed(mesh, scale, Vec3(0));
    const auto scaled = make_backend(backend, scaled_mesh);
    for (const Ray& ray : rays) {
      auto expected = accel->closest_hit(ray);
      if (expected) expected->t *= scale;
      const Ray other{ray.origin * scale, ray.direction, ray.t_min * scale, ray.t_max * scale};
      ++outcome.rays;
      outcome.faults += scaled->closest_hit(other) == expected ? 0 : 1;
    }
  }
  for (const float scale : {1e-6f, 1e6f}) {
    const auto other = transformed(mesh, scale, Vec3(0));
    const Outcome part = judge(backend, other, rays_of_all_kinds(other, 4000));
    outcome.rays += part.rays, outcome.faults += part.faults;
  }
  return outcome;
}

/// 11: duplicates, and slivers 10^6 as long as wide, among sound triangles.
Outcome degenerates(std::string_view backend) {
  auto triangles = random_triangles(300, 0.3f, 68);
  for (std::uint32_t i = 0; i < 100; ++i) {
    Sampler random(69, i, 0);
    const Vec3 a = random_point(random), b = random_point(random);
    triangles.push_back({a, b, (a + b) * 0.5f + random_direction(random) * 1e-6f});
    triangles.push_back(triangles[i]);
  }
  return judge(backend, triangles, rays_of_all_kinds(triangles, 8000));
}

/// The false hit of Embree's issue 387, rebuilt: skinny triangles, 300 long and 0.035 wide, whose planes rays
/// meet at 0.52 degrees, through them and beside; the report's ray hit nothing nearer than 600 and got t =
/// 12291.
Outcome skinny_at_half_a_degree(std::string_view backend) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < 40; ++i) {
    const auto z = static_cast<float>(i);
    triangles.push_back({{600, 0, z}, {900, 0.01f, z + 0.05f}, {750, 0.005f, z + 0.06f}});
  }
  std::vector<Ray> rays;
  const float slope = std::tan(0.52f * 3.14159265f / 180);
  for (std::uint32_t i = 0; i < 8000; ++i) {
    Sampler random(70, i, 0);
    const Triangle& t = triangles[i % triangles.size()];
    const Vec3 target = t.v0 + (t.v1 - t.v0) * random.next() + (t.v2 - t.v0) * (random.next() - 0.5f);
    const Vec3 from = target + Vec3(-600, 600 * slope, 0.1f * random.next());
    rays.push_back({from, (target - from) * (1 / 600.0f)});
  }
  return judge(backend, triangles, rays);
}

/// The disagreement of Embree's issues 51 and 423, rebuilt: an isolated triangle whose edges rays meet within
/// one unit in the last place, from all sides; where exact arithmetic says no, and float32 may not say yes
/// beyond its bounds.
Outcome edges_within_one_unit(std::string_view backend) {
  Outcome outcome;
  for (std::uint32_t i = 0; i < 200; ++i) {
    Sampler random(71, i, 0);
    const Vec3 a = random_direction(random), b = random_direction(random), c = random_direction(random);
    const std::vector<Triangle> one{{a, b, c}};
    std::vector<Ray> rays;
    for (int k = 0; k < 40; ++k) {
      const Vec3 from = random_direction(random) * 3.0f;
      Vec3 target = a + (b - a) * random.next();
      for (int axis = 0; axis < 3; ++axis) {
        target[axis] = std::nextafter(target[axis], random.next() < 0.5f ? -9.0f : 9.0f);
      }
      rays.push_back({from, target - from});
    }
    const Outcome part = judge(backend, one, rays);
    outcome.rays += part.rays, outcome.faults += part.faults;
  }
  return outcome;
}

}  // namespace

std::span<const HardCase> mesh_cases() {
  static constexpr HardCase cases[] = {
      {"1 edges and vertices of a closed mesh", "no ray leaves", leaks_of_a_sphere},
      {"2 random triangles, all kinds of rays", "the oracle agrees", random_triangles_of_all_sizes},
      {"3 whole-number lattices in their planes", "the oracle agrees", whole_number_lattices},
      {"4 walls on the bounding box", "no ray is lost", walls_on_the_bounding_box, true},
      {"5 starts and ties of the cell walk", "the oracle agrees", starts_and_ties_of_the_walk},
      {"6 a thousand cells in a row", "the oracle agrees", a_thousand_cells_in_a_row},
      {"7 flat scenes and single triangles", "the oracle agrees", flat_scenes},
      {"8 teapot in a stadium", "the oracle agrees", teapot_in_a_stadium},
      {"9 offsets of 1e4, 1e6, 1e7", "the oracle agrees", huge_offsets},
      {"10 scales 2^-20 to 2^20, 1e-6, 1e6", "the same bits", scales},
      {"11 slivers and duplicates", "the oracle agrees", degenerates},
      {"Embree 387: skinny, half a degree", "the oracle agrees", skinny_at_half_a_degree},
      {"Embree 423, 51: edges to the last bit", "the oracle agrees", edges_within_one_unit}};
  return cases;
}

}  // namespace lemma::test
