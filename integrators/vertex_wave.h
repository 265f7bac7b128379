#pragma once

#include <vector>

#include "src/core/frame.h"
#include "src/lights/light_sampler.h"
#include "src/shading/phong_wave.h"

namespace lemma {

/// Where the ray of each lane meets its triangle.
struct TouchWave {
  VecWave v0, v1, v2;
  VecWave direction;  // of the ray
  Wave<float> b1, b2;

  void set_triangle(std::size_t lane, const Triangle& t) {
    v0.set(lane, t.v0), v1.set(lane, t.v1), v2.set(lane, t.v2);
  }
  [[nodiscard]] Triangle triangle(std::size_t lane) const { return {v0[lane], v1[lane], v2[lane]}; }
};

/// Vertex of each lane, where normals are flat and nothing is glass.
struct VertexWave {
  LightQueryWave query;    // Vertex::origin(), shading_normal() and, of specular ones, reflection()
  VecWave s, t;            // the shading frame; its third axis is query.n
  VecWave wo;              // in that frame
  MaterialWave materials;  // to be set by who asks, as are `diffuse`, `peak` and `width` of the query

  [[nodiscard]] Frame frame(std::size_t lane) const { return {s[lane], t[lane], query.n[lane]}; }
};

/// What Vertex does, for the first `count` lanes, compiled for one instruction set.
struct VertexStages {
  /// Finds all of the vertices but what is to be set.
  void (*find)(const TouchWave& touches, std::size_t count, VertexWave& vertices);
  /// Directions of world space in the vertices' frames, and the other way.
  void (*to_local)(const VertexWave& vertices, const VecWave& w, std::size_t count, VecWave& local);
  void (*to_world)(const VertexWave& vertices, const VecWave& w, std::size_t count, VecWave& world);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the bits of Vertex.
[[nodiscard]] const std::vector<VertexStages>& all_vertex_stages();

}  // namespace lemma
