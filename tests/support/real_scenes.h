#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace lemma::test {

/// The folder with the scenes of the course, which carry no licence and so are no part of the project;
/// nothing where LEMMA_REAL_SCENES names none.
[[nodiscard]] inline std::optional<std::filesystem::path> real_scenes() {
  const char* const folder = std::getenv("LEMMA_REAL_SCENES");
  return folder == nullptr ? std::nullopt : std::optional<std::filesystem::path>(folder);
}

inline constexpr const char* kNoRealScenes =
    "LEMMA_REAL_SCENES names no folder with the scenes of the course";

}  // namespace lemma::test
