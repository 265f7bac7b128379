#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/core/rgb.h"
#include "src/scene/messages.h"

namespace lemma {

/// A material as an MTL file gives it. Colours are linear and >= 0.
struct MtlMaterial {
  std::string name;
  FilePosition where;  // of its newmtl
  Rgb ka, kd, ks, ke;
  float ns = 1;  // Phong exponent, in [0, 1e6]
  float ni = 1;  // index of refraction
  std::string map_kd;
};

/// Reads Ka, Kd, Ks, Ke (one number is a grey), Ns, Ni and map_Kd of each material, in file order; all else
/// is left out, `Tr` and `d` among it: in the scenes of the course `Tr 1 1 1` stands on opaque materials.
/// @throw SceneError with the line if the file cannot be read or a number is missing, not finite or negative
[[nodiscard]] std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path, Warnings& warnings);

}  // namespace lemma
