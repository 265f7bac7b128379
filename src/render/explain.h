#pragma once

#include <functional>
#include <vector>

#include "integrators/path_recorder.h"
#include "src/render/render.h"

namespace lemma {

/// One sample of a pixel and all that happened on its path.
struct ExplainedSample {
  std::uint32_t index = 0;
  Ray camera_ray;
  std::vector<PathEvent> events;
  Rgb radiance;
};

using ExplainSink = std::function<void(const ExplainedSample&)>;

struct ExplainedPixel {
  Rgb radiance;                       // equal, bit for bit, to that of the pixel in render()
  std::uint64_t invalid_samples = 0;  // left out of it
};

/// Renders one pixel as render() does and passes its samples on, in order.
/// @param x, y        within the image
/// @param strategies  the light samplings whose densities are told
[[nodiscard]] ExplainedPixel explain_pixel(const World& world, const Integrator& integrator,
                                           const RenderSettings& settings, int x, int y,
                                           PathRecorder::Strategies strategies, const ExplainSink& sink);

}  // namespace lemma
