#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "src/scene/text_file.h"

namespace lemma::fuzz {

/// Gives the bytes to a reader as a file of this name would be; what it refuses with a message is no finding.
template <class Read>
int read_text(const char* name, const std::uint8_t* data, std::size_t size, const Read& read) {
  Warnings warnings;
  try {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    read(checked_text(name, bytes, warnings), warnings);
  } catch (const SceneError&) {
    return 0;
  }
  return 0;
}

}  // namespace lemma::fuzz
