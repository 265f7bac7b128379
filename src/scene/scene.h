#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/core/rgb.h"
#include "src/core/triangle.h"
#include "src/lights/emitter.h"
#include "src/scene/camera.h"
#include "src/scene/overlays.h"
#include "src/shading/phong.h"

namespace lemma {

/// The parts of the model that cost something in the hot path. They are compile-time constants of the
/// integrators: a scene pays for what it needs only.
struct Model {
  bool specular = false;        // a reflecting triangle has ks > 0
  bool smooth_normals = false;  // a reflecting triangle has vertex normals that differ from its own
  bool overlays = false;        // an emitter lies in the plane of another triangle, on top of it
};

/// What a scene needs, found while loading.
struct SceneNeeds {
  Model model;
  std::size_t lights = 0;             // lights (materials that emit) with at least one triangle
  std::size_t emitter_triangles = 0;  // triangles of all lights
};

/// "Lambert + Phong, opaque, no textures, flat normals, 4 lights (3040 triangles)".
[[nodiscard]] std::string describe(const SceneNeeds& needs);

inline constexpr std::uint32_t kNoEmitter = 0xFFFFFFFFu;

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
  std::vector<Emitter> emitters;
  Overlays overlays;
  SceneNeeds needs;
};

}  // namespace lemma
