#pragma once

#include <filesystem>
#include <string>
#include <string_view>
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
  float ni = 1;  // index of refraction, > 0
  // As written: one number, three, or none if the file has none that makes sense.
  std::vector<float> tr;     // transparency or, three numbers, a transmittance
  std::vector<float> d;      // dissolve: 1 is opaque
  std::vector<float> illum;  // illumination model
  std::string map_kd;
  FilePosition map_kd_where;
  bool inside_out = false;  // of glass: the side that the winding's normal points to is the inner one
};

/// Reads Ka, Kd, Ks, Ke (one number is a grey), Ns, Ni, Tr, d, illum and map_Kd of each material, in file
/// order; all else is left out. What Tr and d mean is for others to say: see glass_of().
/// @throw SceneError with the line if the file cannot be read or a number is missing, not finite or negative
[[nodiscard]] std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path, Warnings& warnings);

/// The same for a text that is in memory already.
/// @param path  what messages call it
[[nodiscard]] std::vector<MtlMaterial> parse_mtl(const std::filesystem::path& path, std::string_view text,
                                                 Warnings& warnings);

}  // namespace lemma
