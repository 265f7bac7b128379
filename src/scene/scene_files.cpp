#include "src/scene/scene_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "src/scene/ascii.h"
#include "src/scene/read_xml.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool has_extension(const fs::path& path, std::string_view extension) {
  return lower_case(path.extension().string()) == extension;
}

/// All files of a folder in order of their names, without hidden ones. Nothing if it cannot be read.
std::vector<fs::path> list_files(const fs::path& folder, std::string_view extension) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path name = entry->path().filename();
    const bool hidden = name.string().starts_with('.');
    if (!hidden && has_extension(name, extension) && is_file(folder / name)) files.push_back(folder / name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string names_of(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const fs::path& file : files) names.push_back(file.filename().string());
  return join_names(names);
}

SceneError none_found(const fs::path& where, std::string_view extension) {
  if (extension == ".xml") {
    return {
        {where},
        "there is no XML file with camera and lights",
        fmt::format("write one beside the OBJ, with the same stem: {} {}", kCameraExample, kLightExample)};
  }
  return {{where}, "there is no OBJ file with the geometry", "put it beside the XML"};
}

/// The only file of a kind in a folder.
/// @param where  what to blame if there is none or several
fs::path only_file(const fs::path& folder, std::string_view extension, const fs::path& where) {
  const std::vector<fs::path> files = list_files(folder, extension);
  if (files.empty()) throw none_found(where, extension);
  if (files.size() > 1) {
    throw SceneError({where},
                     fmt::format("which {} file? There are {}", extension.substr(1), names_of(files)),
                     "name the XML, and give the OBJ the same stem");
  }
  return files.front();
}

/// The file of another kind that goes with `file`.
fs::path companion(const fs::path& file, std::string_view extension) {
  const fs::path folder = file.parent_path();
  for (const fs::path& other : list_files(folder, extension)) {
    if (other.stem() == file.stem()) return other;
  }
  return only_file(folder, extension, file);
}

/// The entry of a folder that has a name in whatever case, the first by name; nothing if there is none.
std::optional<fs::path> find_entry(const fs::path& folder, const fs::path& name) {
  std::optional<fs::path> found;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path other = entry->path().filename();
    if (lower_case(other.string()) == lower_case(name.string()) && (!found || other < *found)) found = other;
  }
  if (!found) return std::nullopt;
  return folder / *found;
}

/// A file below a folder, each part of its name in whatever case.
std::optional<fs::path> find_ignoring_case(const fs::path& folder, const fs::path& name) {
  fs::path path = folder;
  for (const fs::path& part : name) {
    if (std::error_code error; fs::exists(path / part, error)) {
      path /= part;
    } else if (const auto entry = find_entry(path, part)) {
      path = *entry;
    } else {
      return std::nullopt;
    }
  }
  return is_file(path) ? std::optional(path) : std::nullopt;
}

/// "a.mtl b\ c.mtl" -> "a.mtl", "b c.mtl".
std::vector<std::string> split_names(std::string_view text) {
  std::vector<std::string> names;
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escaped = text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ' ';
    if (escaped) ++i;
    if (escaped || (text[i] != ' ' && text[i] != '\t')) {
      name += text[i];
    } else if (!name.empty()) {
      names.push_back(std::exchange(name, {}));
    }
  }
  if (!name.empty()) names.push_back(name);
  return names;
}

/// Adds a file that a line leads to, once; warns if its name is not what the line says.
void add_file(const FoundFile& found, const std::string& name, const FilePosition& where,
              std::vector<fs::path>& files, Warnings& warnings) {
  if (!found.as_written) {
    warn(warnings, where,
         fmt::format("there is no {}; {} is used", in_quotes(name), found.path.filename().string()));
  }
  if (std::find(files.begin(), files.end(), found.path) == files.end()) files.push_back(found.path);
}

constexpr const char* kWhatToName = "name the XML, the OBJ, or the folder that holds both";

void require_existence(const fs::path& scene) {
  std::error_code error;
  if (!fs::exists(scene, error)) throw SceneError({scene}, "no such file or folder", kWhatToName);
}

SceneError neither(const fs::path& scene) {
  return {{scene}, "this is neither XML nor OBJ", kWhatToName};
}

}  // namespace

std::optional<FoundFile> find_file(const fs::path& folder, const std::string& name) {
  if (is_file(folder / name)) return FoundFile{folder / name, true};
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  if (const auto file = find_ignoring_case(folder, slashes)) return FoundFile{*file};
  if (const auto file = find_ignoring_case(folder, fs::path(slashes).filename())) return FoundFile{*file};
  return std::nullopt;
}

SceneFiles find_scene_files(const fs::path& scene) {
  require_existence(scene);
  std::error_code error;
  if (fs::is_directory(scene, error)) {
    const fs::path xml = only_file(scene, ".xml", scene);
    return {xml, companion(xml, ".obj")};
  }
  if (has_extension(scene, ".xml")) return {scene, companion(scene, ".obj")};
  if (has_extension(scene, ".obj")) return {companion(scene, ".xml"), scene};
  throw neither(scene);
}

fs::path find_obj(const fs::path& scene) {
  require_existence(scene);
  if (has_extension(scene, ".obj")) return scene;
  if (has_extension(scene, ".xml")) return companion(scene, ".obj");
  std::error_code error;
  if (!fs::is_directory(scene, error)) throw neither(scene);
  const std::vector<fs::path> xml = list_files(scene, ".xml");
  return xml.size() == 1 ? companion(xml.front(), ".obj") : only_file(scene, ".obj", scene);
}

std::vector<fs::path> find_mtl_files(const fs::path& obj, const std::vector<ObjName>& libraries,
                                     Warnings& warnings) {
  const fs::path folder = obj.parent_path();
  std::vector<fs::path> files;
  std::vector<ObjName> missing;
  for (const auto& [text, where] : libraries) {
    if (const auto whole = find_file(folder, text)) {  // one name, perhaps with blanks
      add_file(*whole, text, where, files, warnings);
      continue;
    }
    for (const std::string& name : split_names(text)) {
      if (const auto found = find_file(folder, name)) {
        add_file(*found, name, where, files, warnings);
      } else {
        missing.push_back({in_quotes(name), where});
      }
    }
  }
  if (libraries.empty()) missing.push_back({"mtllib line", {obj}});
  std::string instead;
  if (const auto all = list_files(folder, ".mtl"); files.empty() && all.size() == 1) {
    files = all;
    instead = fmt::format("; {} is used", all.front().filename().string());
  }
  for (const auto& [name, where] : missing)
    warn(warnings, where, fmt::format("there is no {}{}", name, instead));
  return files;
}

}  // namespace lemma
