#pragma once

namespace lemma {

/// Does what the command line says and returns the exit code.
/// @throw ArgumentError if it cannot be understood, and what the commands throw
[[nodiscard]] int run_command_line(int argc, const char* const* argv);

}  // namespace lemma
