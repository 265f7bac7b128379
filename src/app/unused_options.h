#pragma once

#include "src/app/options.h"
#include "src/scene/messages.h"

namespace lemma {

/// A warning for every option that is not at its default but changes nothing beside the others.
[[nodiscard]] Warnings unused_options(const RenderOptions& options);

}  // namespace lemma
