#pragma once

#include "src/app/exit_code.h"
#include "src/app/options.h"

namespace lemma {

/// `lemma render`: loads, builds, renders, writes.
/// @throw std::runtime_error whose what() is the message for the user
[[nodiscard]] ExitCode run_render(const RenderOptions& options);

}  // namespace lemma
