#pragma once

#include <filesystem>
#include <optional>
#include <string>
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

/// A file that a name in a scene led to.
struct FoundFile {
  std::filesystem::path path;
  bool as_written = false;
};

/// The file that a name means, as written, relative to a folder; else with '/' for '\' and in whatever case;
/// else its last part in the folder itself, in whatever case.
[[nodiscard]] std::optional<FoundFile> find_file(const std::filesystem::path& folder,
                                                 const std::string& name);

/// The MTL files that the mtllib lines of an OBJ mean, each once, by find_file(); if none is found at all,
/// the only MTL of the folder. All but the first are warned of, and so is a name without a file.
[[nodiscard]] std::vector<std::filesystem::path> find_mtl_files(const std::filesystem::path& obj,
                                                                const std::vector<ObjName>& libraries,
                                                                Warnings& warnings);

}  // namespace lemma
