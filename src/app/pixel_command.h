#pragma once

#include "integrators/integrator.h"
#include "src/app/exit_code.h"
#include "src/app/options.h"

namespace lemma {

/// Refuses options that cannot be had together with --pixel, or only with it.
/// @throw ArgumentError
void check_pixel_options(const RenderOptions& options);

/// `lemma render --pixel`: renders that pixel alone, bit for bit as in the image, and tells its radiance;
/// with
/// --explain also all that happens on its paths.
/// @throw ArgumentError if the image has no such pixel
[[nodiscard]] ExitCode run_pixel(const RenderOptions& options, const World& world,
                                 const Integrator& integrator);

}  // namespace lemma
