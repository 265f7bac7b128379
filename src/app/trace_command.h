#pragma once

#include <filesystem>
#include <string>

#include "accel/accelerator.h"
#include "src/app/exit_code.h"

namespace CLI {
class App;
}

namespace lemma {

/// Everything `lemma trace` can be told.
struct TraceOptions {
  std::filesystem::path scene, rays, output;
  Named<AcceleratorFactory> accel = accelerators().front();
  bool any = false;    // whether there is a hit, not which
  bool quiet = false;  // nothing is printed but errors
};

/// Adds the command and binds its options to `options`.
CLI::App* add_trace_command(CLI::App& app, TraceOptions& options);

/// `lemma trace`: reads rays, asks one accelerator, writes hits.
/// @throw std::runtime_error whose what() is the message for the user
[[nodiscard]] ExitCode run_trace(const TraceOptions& options);

}  // namespace lemma
