#pragma once

#include <optional>
#include <vector>

#include "src/app/options.h"
#include "src/app/progress.h"
#include "src/app/summary.h"
#include "src/render/read_image.h"

namespace lemma {

/// Reads the reference that options name, if they do, and checks that images of this view can be compared
/// with it.
/// @throw std::runtime_error whose what() is the message for the user
[[nodiscard]] std::optional<ReadImage> read_reference(const RenderOptions& options, const CameraView& view);

struct PassesResult {
  RenderResult result;
  std::vector<ErrorPoint> curve;                  // one point a pass, if there is a reference
  std::optional<ReferenceNoise> reference_noise;  // if it tells its variance
  std::optional<bool> target_reached;             // if there is a target
};

/// Renders as many samples as options ask for: a number, a time, or an error.
[[nodiscard]] PassesResult render_passes(const World& world, const Integrator& integrator,
                                         const RenderOptions& options,
                                         const std::optional<ReadImage>& reference, Progress& progress);

}  // namespace lemma
