#include "src/scene/geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "src/scene/glass.h"
#include "src/scene/obj_shape.h"

namespace lemma {
namespace {

/// Vertex normals this close to the geometric normal are the same one, printed with six digits: a coordinate
/// is then off by 5e-6 of its size, and the normal of a face 1/40 as high as its coordinates by 2e-4.
constexpr double kFlatDistance = 2e-4;

/// Unit normal that the file gives a corner; 0 if none, or none that has a direction.
Vec3d given_normal(const ObjFile& obj, std::uint32_t index) {
  if (index == kNoIndex) return Vec3d(0);
  const Vec3 normal = obj.normals[index];
  if (!is_finite(normal) || normal == Vec3(0)) return Vec3d(0);
  return normalize(Vec3d(normal));
}

/// The normals of a triangle as its vertices see them.
struct VertexNormals {
  std::array<Vec3, 3> normals;  // unit; the geometric normal, on their side, where the file gives none
  bool oppose_winding = false;  // their mean points against the normal of the winding
  bool flat = true;             // all are the geometric normal, on either side
};

VertexNormals normals_of(const ObjFile& obj, const ObjTriangle& t, const Triangle& shape) {
  std::array<Vec3d, 3> given;
  Vec3d sum(0);
  for (std::size_t k = 0; k < 3; ++k) {
    given[k] = given_normal(obj, t.normal[k]);
    sum += given[k];
  }

  VertexNormals result;
  Vec3d geometric = normalize(area_vector(shape));
  result.oppose_winding = dot(sum, geometric) < 0;
  if (result.oppose_winding) geometric = -geometric;
  for (std::size_t k = 0; k < 3; ++k) {
    if (given[k] == Vec3d(0)) given[k] = geometric;
    result.normals[k] = Vec3(given[k]);
    const Vec3d off = given[k] - geometric, off_behind = given[k] + geometric;
    result.flat &= std::min(dot(off, off), dot(off_behind, off_behind)) <= kFlatDistance * kFlatDistance;
  }
  return result;
}

/// The triangle that emits to the side its vertex normals point to.
Triangle facing(Triangle shape, const VertexNormals& normals) {
  if (normals.oppose_winding) std::swap(shape.v1, shape.v2);
  return shape;
}

bool has_texture(const MtlMaterial& m) {
  return !m.map_kd.empty();
}

Vec2 texcoord(const ObjFile& obj, std::uint32_t index) {
  const Vec2 none(0);
  if (index == kNoIndex) return none;
  const Vec2 given = obj.texcoords[index];
  return std::isfinite(given.x) ? given : none;
}

bool has_texcoords(const ObjFile& obj, const ObjTriangle& t) {
  return std::ranges::all_of(t.texcoord, [&](std::uint32_t index) {
    return index != kNoIndex && std::isfinite(obj.texcoords[index].x);
  });
}

std::array<Vec2, 3> texcoords_of(const ObjFile& obj, const ObjTriangle& t) {
  return {texcoord(obj, t.texcoord[0]), texcoord(obj, t.texcoord[1]), texcoord(obj, t.texcoord[2])};
}

/// Copies of materials for triangles that these do not fit, each made once.
class MaterialCopies {
 public:
  explicit MaterialCopies(std::vector<MtlMaterial>& materials) : materials_(materials) {}

  std::uint32_t find(std::uint32_t of, bool inside_out, bool untextured) {
    const auto [entry, is_new] = copies_.try_emplace(std::tuple(of, inside_out, untextured),
                                                     static_cast<std::uint32_t>(materials_.size()));
    if (is_new) {
      MtlMaterial copy = materials_[of];
      copy.inside_out = inside_out;
      if (untextured && is_black(copy.kd)) copy.kd = kGrey;
      if (untextured) copy.map_kd.clear();
      materials_.push_back(std::move(copy));
    }
    return entry->second;
  }

 private:
  std::vector<MtlMaterial>& materials_;
  std::map<std::tuple<std::uint32_t, bool, bool>, std::uint32_t> copies_;
};

/// Takes the memory at once: a vector that grows holds everything twice for a while.
void reserve(std::size_t triangles, bool textured, Scene& scene) {
  scene.triangles.reserve(triangles);
  scene.facets.reserve(triangles);
  scene.normals.reserve(triangles);
  if (textured) scene.texcoords.reserve(triangles);
}

}  // namespace

void build_geometry(const ObjFile& obj, const LightList& lights, MaterialTable& materials, Scene& scene,
                    LoadReport& report) {
  const bool textured = std::ranges::any_of(materials.materials, has_texture);
  MaterialCopies copies(materials.materials);
  report.triangles_read = obj.triangles.size();
  reserve(obj.triangles.size(), textured, scene);
  for (const ObjTriangle& t : obj.triangles) {
    const Triangle shape = shape_of(obj, t);
    const Soundness soundness = soundness_of(shape);
    report.dropped_non_finite += soundness == Soundness::not_finite ? 1 : 0;
    report.dropped_zero_area += soundness == Soundness::zero_area ? 1 : 0;
    if (soundness != Soundness::sound) continue;
    const VertexNormals normals = normals_of(obj, t, shape);
    report.opposed_normals += normals.oppose_winding ? 1 : 0;
    Facet facet{.material = materials.of_obj[t.material]};
    if (const std::uint32_t light = lights.of_material[facet.material]; light != kNoLight) {
      facet.emitter = static_cast<std::uint32_t>(scene.emitters.size());
      scene.emitters.push_back({.shape = facing(shape, normals),
                                .radiance = lights.lights[light].radiance,
                                .triangle = static_cast<std::uint32_t>(scene.triangles.size()),
                                .light = light});
    } else {
      scene.needs.model.smooth_normals |= !normals.flat;
      const MtlMaterial& material = materials.materials[facet.material];
      const bool inside_out = normals.oppose_winding && is_glass(material);
      const bool untextured = has_texture(material) && !has_texcoords(obj, t);
      report.without_texcoords += untextured ? 1 : 0;
      if (inside_out || untextured) facet.material = copies.find(facet.material, inside_out, untextured);
    }
    if (textured) scene.texcoords.push_back(texcoords_of(obj, t));
    scene.triangles.push_back(shape);
    scene.facets.push_back(facet);
    scene.normals.push_back(normals.normals);
  }
  if (!scene.needs.model.smooth_normals) decltype(scene.normals)().swap(scene.normals);
}

}  // namespace lemma
