#pragma once

#include "src/lights/body_mesh.h"

namespace lemma {

/// BodyMesh::first_hit, compiled for one instruction set.
struct BodyTrace {
  std::optional<BodyMesh::Point> (*first_hit)(const BodyMesh& mesh, const Vec3& x, const Vec3d& w);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the same points, bit for bit.
[[nodiscard]] const std::vector<BodyTrace>& body_traces();

}  // namespace lemma
