#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "src/core/named.h"
#include "src/core/rgb.h"
#include "src/core/triangle.h"
#include "src/lights/emitter.h"
#include "src/scene/camera.h"
#include "src/scene/overlays.h"
#include "src/shading/dielectric.h"
#include "src/shading/phong.h"
#include "src/shading/texture.h"

namespace lemma {

/// The parts of the model that cost something in the hot path. They are compile-time constants of the
/// integrators: a scene pays for what it needs only, but that textures and glass come together
/// (integrators/integrator.h).
struct Model {
  bool specular = false;        // a reflecting triangle has ks > 0
  bool smooth_normals = false;  // a reflecting triangle has vertex normals that differ from its own
  bool textures = false;        // a reflecting triangle has a texture
  bool glass = false;           // a triangle is a boundary of glass
  bool overlays = false;        // an emitter lies in the plane of another triangle, on top of it
};

/// What a texture does with the Kd of its material.
enum class TextureRule {
  replace,  // stands in its place, as in the course's renderers
  multiply  // is multiplied with it, as the MTL specification says
};

[[nodiscard]] std::span<const Named<TextureRule>> texture_rules();

/// What a scene needs, found while loading.
struct SceneNeeds {
  Model model;
  std::size_t lights = 0;             // lights (materials that emit) with at least one triangle
  std::size_t emitter_triangles = 0;  // triangles of all lights
  std::size_t textures = 0;           // images on triangles that reflect
  TextureRule texture_rule = TextureRule::replace;
};

/// "Lambert + Phong, opaque, no textures, flat normals, 4 lights (3040 triangles)", or
/// "Lambert, glass, 3 textures in place of Kd, ...".
[[nodiscard]] std::string describe(const SceneNeeds& needs);

inline constexpr std::uint32_t kNoTexture = 0xFFFFFFFFu;

/// The texture of a material: its Kd at a point is tint x what the texture has there.
struct MaterialTexture {
  std::uint32_t texture = kNoTexture;  // index into Scene::textures
  Rgb tint;
};

/// What a triangle is made of.
struct Facet {
  std::uint32_t material = 0;
  std::uint32_t emitter = kNoEmitter;  // index into Scene::emitters
};

/// Everything that light transport sees, immutable once loaded. Triangles keep the order and winding of the
/// file.
struct Scene {
  CameraView view;
  std::vector<Triangle> triangles;
  std::vector<Facet> facets;  // one per triangle
  std::vector<std::array<Vec3, 3>>
      normals;  // unit, one set per triangle; empty unless needs.model.smooth_normals
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<MaterialTexture> texture_of;  // of each material; empty unless needs.model.textures
  std::vector<std::array<Vec2, 3>>
      texcoords;                  // finite, one set per triangle; empty unless needs.model.textures
  std::vector<Dielectric> glass;  // of each material, ior 1: none; empty unless needs.model.glass
  std::vector<Emitter> emitters;
  Overlays overlays;
  SceneNeeds needs;
};

}  // namespace lemma
