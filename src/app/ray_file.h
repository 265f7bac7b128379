#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/hit.h"
#include "src/core/ray.h"

namespace lemma {

/// Rays as programs exchange them: 8 float32 each, in the machine's order: origin x y z, t_min, direction
/// x y z, t_max.
/// @throw std::runtime_error if the file is missing, empty, or no whole number of rays
[[nodiscard]] std::vector<Ray> read_rays(const std::filesystem::path& path);

/// The same for bytes that are in memory already.
/// @param path  what messages call it
[[nodiscard]] std::vector<Ray> parse_rays(const std::filesystem::path& path, std::string_view bytes);

/// The bytes of one ray in such a file.
[[nodiscard]] std::string ray_bytes(const Ray& ray);

/// The bytes of hits, 16 each: int32 triangle, float32 t, b1, b2; for no hit -1, 0, 0, 0.
[[nodiscard]] std::string hit_bytes(std::span<const std::optional<Hit>> hits);

}  // namespace lemma
