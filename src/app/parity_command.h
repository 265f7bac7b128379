#pragma once

#include <cstdint>
#include <filesystem>

#include "src/app/exit_code.h"
#include "src/app/options.h"

namespace lemma {

/// Everything `lemma parity` can be told.
struct ParityOptions {
  std::filesystem::path scene;
  std::filesystem::path json;  // empty: none
  std::uint32_t rays = 1000000;
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all
  ProgressStyle progress = ProgressStyle::automatic;
  bool quiet = false;  // nothing is printed but errors
};

/// Adds the command and binds its options to `options`.
CLI::App* add_parity_command(CLI::App& app, ParityOptions& options);

/// `lemma parity`: every accelerator against the exact oracle.
/// @return kComparisonFailed if one of our own accelerators gave an answer that cannot be
/// @throw std::runtime_error whose what() is the message for the user
[[nodiscard]] ExitCode run_parity(const ParityOptions& options);

}  // namespace lemma
