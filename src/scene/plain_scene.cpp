#include "src/scene/plain_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "src/scene/light_set.h"
#include "src/scene/obj_lines.h"
#include "src/scene/scene_values.h"

namespace lemma {
namespace {

/// The properties of the camera, as a line each says them.
struct PlainProperty {
  std::string_view name, example;
};
constexpr std::array<PlainProperty, 7> kCamera{{{"type", "type perspective"},
                                                {"width", "width 1280"},
                                                {"height", "height 720"},
                                                {"fovy", "fovy 40"},
                                                {"eye", "eye 0 1 5"},
                                                {"lookat", "lookat 0 1 0"},
                                                {"up", "up 0 1 0"}}};
constexpr std::string_view kLight = "mtlname", kLightLine = "mtlname Light 17 12 4";

const PlainProperty* find_property(std::string_view name) {
  const auto found =
      std::find_if(kCamera.begin(), kCamera.end(), [&](const PlainProperty& p) { return p.name == name; });
  return found == kCamera.end() ? nullptr : &*found;
}

/// A text without its last word; that word.
std::pair<std::string_view, std::string_view> split_last_word(std::string_view text) {
  const std::size_t blank = text.find_last_of(" \t");
  if (blank == text.npos) return {"", text};
  const std::string_view before = text.substr(0, blank);
  return {before.substr(0, before.find_last_not_of(" \t") + 1), text.substr(blank + 1)};
}

class PlainReader {
 public:
  PlainReader(const std::filesystem::path& path, Warnings& warnings)
      : path_(path), warnings_(warnings), lights_(warnings) {}

  XmlScene read(std::string_view text) {
    LineCursor cursor(text);
    while (const std::optional<ObjLine> line = cursor.next()) read_line(*line);
    if (values_.empty() && unknown_ > 0) {
      throw SceneError({path_}, "this is neither XML nor the plain text of a scene",
                       fmt::format("XML starts with '<'; plain text has lines such as {} and {}",
                                   kCamera[1].example, kLightLine));
    }
    XmlScene scene;
    if (const auto type = values_.find("type"); type != values_.end()) require_perspective(type->second);
    scene.view = {.eye = to_vector(require("eye")),
                  .look_at = to_vector(require("lookat")),
                  .up = to_vector(require("up")),
                  .fovy = to_fovy(require("fovy")),
                  .width = to_edge(require("width")),
                  .height = to_edge(require("height"))};
    require_directions(scene.view, require("lookat").where, require("up").where);
    scene.lights = lights_.take();
    scene.dialect = "plain text";
    return scene;
  }

 private:
  void read_line(const ObjLine& line) {
    const FilePosition where{path_, line.number};
    if (line.keyword == kLight) return add_light(line.rest, where);
    const PlainProperty* property = find_property(line.keyword);
    if (property == nullptr) {
      if (unknown_++ == 0) {
        warn(warnings_, where, fmt::format("{} is unknown and left out", in_quotes(line.keyword)));
      }
      return;
    }
    const SceneValue value{property->name, property->example, std::string(line.rest), where};
    if (!values_.emplace(property->name, value).second) {
      throw SceneError(where, fmt::format("{} is given twice", property->name), "keep one of them");
    }
  }

  /// The last three words are the radiance: a name may hold blanks.
  void add_light(std::string_view rest, const FilePosition& where) {
    std::string_view name = rest;
    for (int k = 0; k < 3; ++k) name = split_last_word(name).first;
    const std::string_view numbers = rest.substr(name.size());
    require_name({kLight, kLightLine, std::string(name), where});
    lights_.add(
        {std::string(name), to_radiance({"radiance", kLightLine, std::string(numbers), where}), where});
  }

  [[nodiscard]] const SceneValue& require(std::string_view name) const {
    if (const auto value = values_.find(name); value != values_.end()) return value->second;
    throw SceneError({path_}, fmt::format("the camera has no {}", name),
                     fmt::format("for example {}", find_property(name)->example));
  }

  std::filesystem::path path_;
  Warnings& warnings_;
  LightSet lights_;
  std::map<std::string_view, SceneValue> values_;
  std::size_t unknown_ = 0;
};

}  // namespace

bool is_plain_scene(std::string_view text) {
  LineCursor cursor(text);
  const std::optional<ObjLine> line = cursor.next();
  return line && !line->keyword.starts_with('<');
}

XmlScene parse_plain_scene(const std::filesystem::path& path, std::string_view text, Warnings& warnings) {
  return PlainReader(path, warnings).read(text);
}

}  // namespace lemma
