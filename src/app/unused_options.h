#pragma once

#include "src/app/options.h"
#include "src/scene/messages.h"

namespace lemma {

/// Refuses --technique beside an integrator that has techniques of its own: the picture would be another than
/// the command line says.
/// @throw ArgumentError
void check_technique(const RenderOptions& options);

/// A warning for every option that is not at its default but changes nothing beside the others.
[[nodiscard]] Warnings unused_options(const RenderOptions& options);

}  // namespace lemma
