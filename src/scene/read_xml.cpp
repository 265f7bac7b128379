#include "src/scene/read_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "src/scene/light_set.h"
#include "src/scene/plain_scene.h"
#include "src/scene/scene_values.h"
#include "src/scene/text_file.h"

namespace lemma {
namespace {

/// What an element may hold, and how it may be written. Elements, properties and the examples of messages are
/// known by this table alone.
struct Property {
  std::string_view element, name, example;
};
constexpr std::array<Property, 12> kProperties{{
    {"camera", "type", R"(type="perspective")"},
    {"camera", "width", R"(width="1280")"},
    {"camera", "height", R"(height="720")"},
    {"camera", "fovy", R"(fovy="40")"},
    {"camera", "eye", R"(<eye x="0" y="1" z="5"/>)"},
    {"camera", "lookat", R"(<lookat x="0" y="1" z="0"/>)"},
    {"camera", "up", R"(<up x="0" y="1" z="0"/>)"},
    {"light", "mtlname", R"(mtlname="Light")"},
    {"light", "radiance", R"(radiance="17, 12, 4")"},
    {"sphere", "mtlname", R"(mtlname="Light")"},
    {"sphere", "center", R"(center="0, 1, 0")"},
    {"sphere", "radius", R"(radius="0.1")"},
}};
constexpr std::array<const char*, 2> kRoots{"scene", "root"};
constexpr std::array<std::string_view, 4> kValueAttributes{"value", "x", "y", "z"};

const Property* find_property(std::string_view element, std::string_view name) {
  const auto found = std::find_if(kProperties.begin(), kProperties.end(),
                                  [&](const Property& p) { return p.element == element && p.name == name; });
  return found == kProperties.end() ? nullptr : &*found;
}

template <class Range>
bool contains(const Range& range, std::string_view name) {
  return std::find(std::begin(range), std::end(range), name) != std::end(range);
}

/// The value of a child element: its attribute `value`, its x, y, z in a row, or its text.
std::string text_of(const pugi::xml_node& child) {
  if (const pugi::xml_attribute value = child.attribute("value")) return value.value();
  std::string row;
  for (const char* axis : {"x", "y", "z"}) {
    if (const pugi::xml_attribute value = child.attribute(axis)) row.append(value.value()).append(" ");
  }
  return row.empty() ? child.text().get() : row;
}

/// Where the lines of a text start, to find positions without counting from its start each time.
class LineStarts {
 public:
  explicit LineStarts(std::string_view text) {
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
      starts_.push_back(at + 1);
    }
  }

  /// Line and column of a byte, both counted from 1.
  [[nodiscard]] std::pair<int, int> position(std::size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    const std::size_t start = after == starts_.begin() ? 0 : *std::prev(after);
    return {static_cast<int>(1 + (after - starts_.begin())), static_cast<int>(1 + offset - start)};
  }

 private:
  std::vector<std::size_t> starts_;  // of all lines but the first
};

/// More names than this are counted, but not told one by one.
constexpr std::size_t kMostUnknownNames = 20;

class XmlReader {
 public:
  XmlReader(const std::filesystem::path& path, std::string_view text, Warnings& warnings)
      : path_(path), text_(text), lines_(text), warnings_(warnings), lights_(warnings) {}

  XmlScene read() {
    // A fragment: these files have no root element. As UTF-8 whatever the declaration says, so that names
    // stay the bytes that OBJ and MTL have.
    const pugi::xml_parse_result result = document_.load_buffer(
        text_.data(), text_.size(), pugi::parse_default | pugi::parse_fragment, pugi::encoding_utf8);
    if (!result) {
      throw SceneError(position(result.offset), result.description(), "the file must be well-formed XML");
    }
    read_elements(document_);
    for (const char* root : kRoots) {
      for (const pugi::xml_node node : document_.children(root)) {
        root_ = root;
        read_elements(node);
      }
    }
    if (!camera_) {
      throw SceneError({path_}, "there is no <camera>", fmt::format("for example {}", kCameraExample));
    }
    report_unknown();
    scene_.lights = lights_.take();
    scene_.dialect = fmt::format("XML, {}, {}", root_.empty() ? "no root" : fmt::format("<{}>", root_),
                                 children_ ? "children with values" : "attributes");
    return std::move(scene_);
  }

 private:
  FilePosition position(std::ptrdiff_t offset) const {
    const auto [line, column] =
        lines_.position(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return {path_, line, column};
  }

  /// Of an element's '<'; pugixml knows where its name starts.
  FilePosition position(const pugi::xml_node& element) const { return position(element.offset_debug() - 1); }

  void read_elements(const pugi::xml_node& parent) {
    for (const pugi::xml_node node : parent.children()) {
      if (node.type() != pugi::node_element) continue;
      const std::string_view name = node.name();
      const bool root = parent == document_ && contains(kRoots, name);
      if (name == "camera") {
        read_camera(node);
      } else if (name == "light") {
        read_light(node);
      } else if (name == "sphere") {
        read_sphere(node);
      } else if (!root) {
        warn_unknown(node, fmt::format("<{}>", name));
      }
    }
  }

  void warn_unknown(const pugi::xml_node& node, const std::string& what) {
    if (!unknown_.insert(what).second) return;
    if (unknown_.size() <= kMostUnknownNames) {
      warn(warnings_, position(node), what + " is unknown and left out");
    }
  }

  void report_unknown() {
    if (unknown_.size() <= kMostUnknownNames) return;
    warn(warnings_, {path_},
         fmt::format("{} more names are unknown and left out", unknown_.size() - kMostUnknownNames));
  }

  void warn_of_unknown_properties(const pugi::xml_node& element) {
    for (const pugi::xml_attribute attribute : element.attributes()) {
      if (find_property(element.name(), attribute.name())) continue;
      warn_unknown(element, fmt::format("{} of <{}>", attribute.name(), element.name()));
    }
    for (const pugi::xml_node child : element.children()) {
      if (child.type() != pugi::node_element) continue;
      if (!find_property(element.name(), child.name())) {
        warn_unknown(child, fmt::format("<{}> in <{}>", child.name(), element.name()));
        continue;
      }
      for (const pugi::xml_attribute attribute : child.attributes()) {
        if (contains(kValueAttributes, attribute.name())) continue;
        warn_unknown(child, fmt::format("{} of <{}>", attribute.name(), child.name()));
      }
    }
  }

  std::optional<SceneValue> find(const pugi::xml_node& element, const char* name) {
    const Property* property = find_property(element.name(), name);
    const pugi::xml_attribute attribute = element.attribute(name);
    const pugi::xml_node child = element.child(name);
    const pugi::xml_node second = attribute ? child : child.next_sibling(name);
    if (second)
      throw SceneError(position(second), fmt::format("{} is given twice", name), "keep one of them");
    if (attribute) return SceneValue{property->name, property->example, attribute.value(), position(element)};
    if (!child) return std::nullopt;
    children_ |= !child.attribute("x");
    return SceneValue{property->name, property->example, text_of(child), position(child)};
  }

  SceneValue require(const pugi::xml_node& element, const char* name) {
    if (std::optional<SceneValue> value = find(element, name)) return std::move(*value);
    throw SceneError(position(element), fmt::format("<{}> has no {}", element.name(), name),
                     fmt::format("for example {}", find_property(element.name(), name)->example));
  }

  void read_camera(const pugi::xml_node& element) {
    if (camera_) {
      throw SceneError(position(element),
                       fmt::format("a second <camera>; the first is in line {}", camera_->line),
                       "keep one of them");
    }
    camera_ = position(element);
    warn_of_unknown_properties(element);
    if (const std::optional<SceneValue> type = find(element, "type")) require_perspective(*type);
    scene_.view = {.eye = to_vector(require(element, "eye")),
                   .look_at = to_vector(require(element, "lookat")),
                   .up = to_vector(require(element, "up")),
                   .fovy = to_fovy(require(element, "fovy")),
                   .width = to_edge(require(element, "width")),
                   .height = to_edge(require(element, "height"))};
    require_directions(scene_.view, require(element, "lookat").where, require(element, "up").where);
  }

  void read_light(const pugi::xml_node& element) {
    warn_of_unknown_properties(element);
    const SceneValue name = require(element, "mtlname");
    require_name(name);
    lights_.add({name.text, to_radiance(require(element, "radiance")), position(element)});
  }

  void read_sphere(const pugi::xml_node& element) {
    warn_of_unknown_properties(element);
    const SceneValue name = require(element, "mtlname");
    require_name(name);
    scene_.spheres.push_back({name.text, to_vector(require(element, "center")),
                              to_length(require(element, "radius")), position(element)});
  }

  std::filesystem::path path_;
  std::string_view text_;
  LineStarts lines_;
  Warnings& warnings_;
  LightSet lights_;
  pugi::xml_document document_;
  std::set<std::string> unknown_;  // what was warned of
  std::optional<FilePosition> camera_;
  std::string root_;       // the root element, if there is one
  bool children_ = false;  // some property is a child with a value or text
  XmlScene scene_;
};

}  // namespace

XmlScene parse_xml(const std::filesystem::path& path, std::string_view text, Warnings& warnings) {
  if (is_plain_scene(text)) return parse_plain_scene(path, text, warnings);
  return XmlReader(path, text, warnings).read();
}

XmlScene read_xml(const std::filesystem::path& path, Warnings& warnings) {
  return parse_xml(path, read_text_file(path, kMostDescriptionBytes, warnings), warnings);
}

}  // namespace lemma
