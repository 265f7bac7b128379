#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "integrators/integrator.h"
#include "src/render/render.h"
#include "src/scene/load_scene.h"
#include "tests/support/statistics.h"

namespace lemma::test {

/// One of our own scenes, with a smaller image.
[[nodiscard]] Scene own_scene(std::string_view name, int width, int height);

/// What to render a scene with; names as on the command line.
struct Configuration {
  std::string_view accel = "embree", integrator = "mis", lights = "power";
  IntegratorOptions options = {};
  Sequence sequence = Sequence::sobol;
};

[[nodiscard]] RenderResult render_scene(const Scene& scene, const Configuration& configuration,
                                        const RenderSettings& settings);

/// Mean over all pixels and channels.
[[nodiscard]] double image_mean(const Image& image);

/// Image means of `seeds` independent renderings, with the seeds from first_seed on.
[[nodiscard]] Estimate mean_over_seeds(const Scene& scene, const Configuration& configuration,
                                       std::uint32_t spp, std::uint64_t first_seed, int seeds);

/// Number of pixels that differ in any bit.
[[nodiscard]] std::size_t differing_pixels(const Image& a, const Image& b);

}  // namespace lemma::test
