#pragma once

#include <filesystem>
#include <vector>

#include "src/scene/read_mtl.h"
#include "src/scene/scene.h"

namespace lemma {

/// Reads the textures of the materials that a triangle shows, each image once, into scene.textures and
/// scene.texture_of, and fills in scene.needs. An image that is missing or cannot be read is warned of; Kd
/// stands in its place, or grey 0.5 where Kd is black. Image names are looked for as the names of MTL files
/// are, beside the MTL and beside the OBJ.
/// @param shown  of each material whether a triangle reflects by it
void load_textures(const std::vector<MtlMaterial>& materials, const std::vector<bool>& shown,
                   const std::filesystem::path& obj, TextureRule rule, Scene& scene, Warnings& warnings);

}  // namespace lemma
