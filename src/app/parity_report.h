#pragma once

#include <span>
#include <string>

#include "src/app/parity_command.h"
#include "src/parity/check.h"

namespace lemma {

/// Whether the accelerator is somebody else's, whose faults are shown but are not ours to mend.
[[nodiscard]] bool is_foreign(std::string_view accelerator);

/// For people: a table of accelerators and kinds of rays, and what was wrong with a command that shows it
/// again.
[[nodiscard]] std::string parity_text(const ParityOptions& options, std::span<const Record> records);

/// For programs: a JSON object.
[[nodiscard]] std::string parity_json(const ParityOptions& options, std::span<const Record> records);

}  // namespace lemma
