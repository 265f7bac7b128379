#pragma once

#include <array>
#include <vector>

#include "integrators/surface_point.h"
#include "src/core/frame.h"
#include "src/lights/light_sampler.h"
#include "src/shading/phong_wave.h"

namespace lemma {

/// Where the ray of each lane meets its triangle.
struct TouchWave {
  VecWave v0, v1, v2;
  VecWave n0, n1, n2;  // of its vertices, where normals are smooth
  VecWave direction;   // of the ray
  Wave<float> b1, b2;

  void set_triangle(std::size_t lane, const Triangle& t) {
    v0.set(lane, t.v0), v1.set(lane, t.v1), v2.set(lane, t.v2);
  }
  void set_normals(std::size_t lane, const std::array<Vec3, 3>& n) {
    n0.set(lane, n[0]), n1.set(lane, n[1]), n2.set(lane, n[2]);
  }
  [[nodiscard]] VertexNormals normals(std::size_t lane) const { return {n0[lane], n1[lane], n2[lane]}; }
  [[nodiscard]] Triangle triangle(std::size_t lane) const { return {v0[lane], v1[lane], v2[lane]}; }
};

/// Vertex of each lane, where nothing is glass.
struct VertexWave {
  LightQueryWave query;    // Vertex::origin(), shading_normal() and, of specular ones, reflection()
  VecWave s, t;            // the shading frame; its third axis is query.n
  VecWave wo;              // in that frame
  VecWave geometric;       // normal, where normals are smooth
  MaterialWave materials;  // to be set by who asks, as are `diffuse`, `peak` and `width` of the query

  [[nodiscard]] Frame frame(std::size_t lane) const { return {s[lane], t[lane], query.n[lane]}; }
};

/// What Vertex does, for the first `count` lanes, compiled for one instruction set.
struct VertexStages {
  using Find = void (*)(const TouchWave& touches, std::size_t count, VertexWave& vertices);

  /// Finds all of the vertices but what is to be set.
  Find find_flat, find_smooth;
  /// Directions of world space in the vertices' frames, and the other way.
  void (*to_local)(const VertexWave& vertices, const VecWave& w, std::size_t count, VecWave& local);
  void (*to_world)(const VertexWave& vertices, const VecWave& w, std::size_t count, VecWave& world);
  /// Whether directions lie above the horizon of the geometric normal: 1 or 0.
  void (*above)(const VertexWave& vertices, const VecWave& w, std::size_t count,
                Wave<std::uint32_t>& is_above);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the bits of Vertex.
[[nodiscard]] const std::vector<VertexStages>& all_vertex_stages();

}  // namespace lemma
