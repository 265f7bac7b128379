#pragma once

#include "src/scene/light_list.h"
#include "src/scene/load_scene.h"
#include "src/scene/material_table.h"
#include "src/scene/read_obj.h"

namespace lemma {

/// What a scene was made from.
struct SceneParts {
  ObjFile obj;
  MaterialTable table;
  LightList lights;
};

/// Reads all files of a scene and puts them together, even if no image can be made of them.
/// @param parts, loaded  filled in as far as the files can be read
/// @throw SceneError if a file cannot be read
void load_parts(const std::filesystem::path& path, const LoadOptions& options, SceneParts& parts,
                LoadedScene& loaded);

/// @throw SceneError if there is no triangle or no light
void require_renderable(const LoadedScene& loaded, const SceneParts& parts);

}  // namespace lemma
