#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "src/scene/messages.h"
#include "src/scene/read_obj.h"

namespace lemma {

/// The files that make up a scene besides its MTL files.
struct SceneFiles {
  std::filesystem::path xml, obj;
};

/// The files that `scene` stands for: an XML, an OBJ, or the folder of both. What is not named is the file of
/// the same stem beside it, else the only one of its kind in the folder.
/// @throw SceneError if there is none, or more than one to choose from
[[nodiscard]] SceneFiles find_scene_files(const std::filesystem::path& scene);

/// The OBJ that `scene` stands for, which may also be an OBJ or a folder of one without any XML.
/// @throw SceneError if there is none, or more than one to choose from
[[nodiscard]] std::filesystem::path find_obj(const std::filesystem::path& scene);

/// The MTL files that the mtllib lines of an OBJ mean, each once. A name is taken as written, relative to the
/// OBJ; else with '/' for '\', else its last part beside the OBJ, in whatever case; and if no file is found
/// at all, the only MTL of the folder. All but the first are warned of, and so is a name without a file.
[[nodiscard]] std::vector<std::filesystem::path> find_mtl_files(const std::filesystem::path& obj,
                                                                const std::vector<ObjName>& libraries,
                                                                Warnings& warnings);

}  // namespace lemma
