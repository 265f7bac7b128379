#pragma once

#include "src/app/exit_code.h"
#include "src/app/scene_options.h"

namespace lemma {

/// Everything `lemma check` can be told.
struct CheckOptions {
  SceneOptions scene;
  std::filesystem::path json;  // empty: none
  bool quiet = false;          // nothing is printed but errors
};

/// Adds the command and binds its options to `options`.
CLI::App* add_check_command(CLI::App& app, CheckOptions& options);

/// `lemma check`: what was read, what it needs, what is wrong, what it will cost.
/// @return kBadInput if the scene cannot be rendered, or has warnings and the options are strict
[[nodiscard]] ExitCode run_check(const CheckOptions& options);

}  // namespace lemma
