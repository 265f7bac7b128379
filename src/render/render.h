#pragma once

#include <functional>
#include <vector>

#include "integrators/integrator.h"
#include "src/render/film.h"

namespace lemma {

struct RenderSettings {
  std::uint32_t spp = 16;  // samples a pixel
  std::uint64_t seed = 0;
  Sequence sequence = Sequence::sobol;
};

struct RenderResult {
  Image image;
  std::uint64_t camera_samples = 0;
  TraceCounts counts;
  double seconds = 0;                 // wall time of the rendering proper
  std::uint64_t invalid_samples = 0;  // left out of the image
  std::vector<InvalidSample>
      first_invalid;  // some of them, the same whatever the threads; in order of pixels

  static constexpr std::size_t kReportedInvalid = 16;
};

/// Called now and then from any thread with the part done, in [0, 1]; never from two threads at a time.
using ProgressSink = std::function<void(double)>;

/// Renders the scene as its camera sees it, on all threads (src/core/parallel.h). The image is a function of
/// world, integrator and settings alone: each pixel's samples are drawn by their own numbers and summed in
/// order by one task.
[[nodiscard]] RenderResult render(const World& world, const Integrator& integrator,
                                  const RenderSettings& settings, const ProgressSink& progress);

}  // namespace lemma
