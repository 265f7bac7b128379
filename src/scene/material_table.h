#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "src/scene/read_mtl.h"
#include "src/scene/read_obj.h"
#include "src/shading/phong.h"

namespace lemma {

inline constexpr Rgb kGrey{0.5f, 0.5f, 0.5f};  // where nothing better is known

/// All materials of a scene, and which of them the names in the OBJ mean.
struct MaterialTable {
  std::vector<MtlMaterial>
      materials;  // those of the MTL files in file order, then one for each undefined name
  std::vector<std::uint32_t> of_obj;  // of each ObjFile::materials, the index into `materials`
};

/// Reads the MTL files and looks up the names in the OBJ. A name without definition gets Kd 0.5 and nothing
/// else, with a warning.
[[nodiscard]] MaterialTable read_materials(const std::vector<std::filesystem::path>& mtl_files,
                                           const std::vector<ObjName>& names, Warnings& warnings);

/// What the materials reflect; of those with a texture, what stands in its place where there is none: Kd, or
/// a grey of 0.5 if Kd is black. Warned of once, but used as it is: Kd + Ks > 1.
/// @param reflects  of each material whether a triangle reflects by it; the others are not warned of
[[nodiscard]] std::vector<Material> make_materials(const std::vector<MtlMaterial>& materials,
                                                   const std::vector<bool>& reflects, const BrdfOptions& brdf,
                                                   Warnings& warnings);

}  // namespace lemma
