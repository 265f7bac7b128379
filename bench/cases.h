#pragma once

#include <span>
#include <string>
#include <vector>

#include "accel/accelerator.h"
#include "src/core/named.h"
#include "src/core/ray.h"
#include "src/scene/camera.h"

namespace lemma::bench {

/// What is built and traced.
struct Case {
  std::vector<Triangle> triangles;
  CameraView view;
  std::vector<Triangle> lights;  // shadow rays aim at points of these
};

/// Makes the case of a name below, "sphere-N" or "field-N" with a number of triangles N (1000, 16k, 4M), or
/// of the scene in a folder or file.
[[nodiscard]] Case make_case(const std::string& name);

/// The cases of the table of ratios: four, and the staircase where LEMMA_REAL_SCENES names the folder of it,
/// since it may not be part of the project.
[[nodiscard]] std::vector<std::string> case_names();

/// Growth with the number of triangles, from 1k to 4M.
[[nodiscard]] std::vector<std::string> growth_names();

/// Rays as a renderer traces them, in its order: one a pixel in rows of 16, at fixed random numbers.
struct RecordedRays {
  std::vector<Ray> primary;  // from the camera
  std::vector<Ray> bounce;   // from where those hit, cosine-distributed
  std::vector<Ray> shadow;   // from the same points to points of the lights
};

/// How many camera rays [pixels]; the width is a multiple of 16.
struct RaySize {
  int width = 640, height = 360;
};
[[nodiscard]] RecordedRays record_rays(const Case& scene, const Accelerator& accel, const RaySize& size = {});

/// How many rays are asked for at a time: one, a wave of coherent rows, a wave.
enum class Asked { single, rows, wave };

/// How rays are asked for.
struct RayKind {
  std::vector<Ray> RecordedRays::*rays;
  bool any_hit;
  Asked asked;
};
[[nodiscard]] std::span<const Named<RayKind>> ray_kinds();

/// Traces all of the rays.
void trace(const Accelerator& accel, const RecordedRays& rays, const RayKind& kind);

}  // namespace lemma::bench
