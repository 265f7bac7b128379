#include "src/scene/spheres.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace lemma {
namespace {

constexpr int kDivisions = 3;

/// A closed mesh about the origin whose vertices have unit length; triangles wind outwards.
struct UnitSphere {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

UnitSphere icosahedron() {
  const double g = std::numbers::phi;
  UnitSphere mesh{
      .vertices = {{-1, g, 0},
                   {1, g, 0},
                   {-1, -g, 0},
                   {1, -g, 0},
                   {0, -1, g},
                   {0, 1, g},
                   {0, -1, -g},
                   {0, 1, -g},
                   {g, 0, -1},
                   {g, 0, 1},
                   {-g, 0, -1},
                   {-g, 0, 1}},
      .triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3d& v : mesh.vertices) v = normalize(v);
  return mesh;
}

/// Each triangle becomes four; the new vertices are pushed out to the sphere.
UnitSphere divided(UnitSphere mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), next);
    if (is_new) mesh.vertices.push_back(normalize(mesh.vertices[a] + mesh.vertices[b]));
    return entry->second;
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    triangles.insert(triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

double area_of(const UnitSphere& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d& v = mesh.vertices[a];
    sum += 0.5 * length(cross(mesh.vertices[b] - v, mesh.vertices[c] - v));
  }
  return sum;
}

std::uint32_t material_index(const XmlSphere& sphere, std::vector<ObjName>& materials) {
  const auto same = std::find_if(materials.begin(), materials.end(),
                                 [&](const ObjName& m) { return m.name == sphere.material; });
  const auto index = static_cast<std::uint32_t>(same - materials.begin());
  if (same == materials.end()) materials.push_back({sphere.material, sphere.where});
  return index;
}

void add_sphere(const UnitSphere& mesh, const XmlSphere& sphere, double scale, ObjFile& obj) {
  const auto first_vertex = static_cast<std::uint32_t>(obj.vertices.size());
  const auto first_normal = static_cast<std::uint32_t>(obj.normals.size());
  for (const Vec3d& v : mesh.vertices) {
    obj.vertices.emplace_back(Vec3d(sphere.centre) + v * (sphere.radius * scale));
    obj.normals.emplace_back(v);
  }
  const std::uint32_t material = material_index(sphere, obj.materials);
  for (const auto& [a, b, c] : mesh.triangles) {
    ObjTriangle t{.material = material};
    t.vertex = {first_vertex + a, first_vertex + b, first_vertex + c};
    t.normal = {first_normal + a, first_normal + b, first_normal + c};
    obj.triangles.push_back(t);
  }
}

}  // namespace

void add_spheres(const std::vector<XmlSphere>& spheres, ObjFile& obj) {
  if (spheres.empty()) return;
  UnitSphere mesh = icosahedron();
  for (int k = 0; k < kDivisions; ++k) mesh = divided(std::move(mesh));
  const double scale = std::sqrt(4 * std::numbers::pi / area_of(mesh));
  for (const XmlSphere& sphere : spheres) add_sphere(mesh, sphere, scale, obj);
}

}  // namespace lemma
