#pragma once

#include <filesystem>

#include "src/scene/load_scene.h"
#include "src/scene/messages.h"

namespace CLI {
class App;
}

namespace lemma {

/// How a scene is read, for all commands that read one whole.
struct SceneOptions {
  std::filesystem::path scene;
  LoadOptions load;
  bool strict = false;  // a warning is an error
};

/// Adds SCENE and the options to a command and binds them.
void add_scene_options(CLI::App& app, SceneOptions& options);

/// Prints the warnings to stderr.
/// @throw ArgumentError with `strict`, if there are any
void report_warnings(const Warnings& warnings, bool strict);

/// The options that an image depends on, as a command line would say them.
[[nodiscard]] std::string text_of(const LoadOptions& options);

}  // namespace lemma
