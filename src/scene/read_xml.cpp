#include "src/scene/read_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "src/scene/numbers.h"
#include "src/scene/text_file.h"

namespace lemma {
namespace {

constexpr double kLargestEdge = 65536;  // of an image [pixels]
constexpr double kLeastSine = 1e-6;     // of the angle between up and the line of sight

/// What an element may hold, and how it may be written. Elements, properties and the examples of messages are
/// known by this table alone.
struct Property {
  std::string_view element, name, example;
};
constexpr std::array<Property, 9> kProperties{{
    {"camera", "type", R"(type="perspective")"},
    {"camera", "width", R"(width="1280")"},
    {"camera", "height", R"(height="720")"},
    {"camera", "fovy", R"(fovy="40")"},
    {"camera", "eye", R"(<eye x="0" y="1" z="5"/>)"},
    {"camera", "lookat", R"(<lookat x="0" y="1" z="0"/>)"},
    {"camera", "up", R"(<up x="0" y="1" z="0"/>)"},
    {"light", "mtlname", R"(mtlname="Light")"},
    {"light", "radiance", R"(radiance="17, 12, 4")"},
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

/// What the file has for a property, and where.
struct Value {
  const Property* property;
  std::string text;
  FilePosition where;
};

/// The value of a child element: its attribute `value`, its x, y, z in a row, or its text.
std::string text_of(const pugi::xml_node& child) {
  if (const pugi::xml_attribute value = child.attribute("value")) return value.value();
  std::string row;
  for (const char* axis : {"x", "y", "z"}) {
    if (const pugi::xml_attribute value = child.attribute(axis)) row.append(value.value()).append(" ");
  }
  return row.empty() ? child.text().get() : row;
}

std::string example_of(const Property& property) {
  return fmt::format("for example {}", property.example);
}

SceneError bad_value(const Value& value, std::string_view what) {
  return {value.where, fmt::format("{} is {}: {}", value.property->name, in_quotes(value.text), what),
          example_of(*value.property)};
}

double read_number(const Value& value) {
  const auto numbers = parse_numbers(value.text);
  if (!numbers || numbers->size() != 1) throw bad_value(value, "a number is needed");
  return numbers->front();
}

int read_edge(const Value& value) {
  const double edge = read_number(value);
  if (!(edge >= 1 && edge <= kLargestEdge && edge == std::floor(edge))) {
    throw bad_value(value, "a whole number from 1 to 65536 is needed");
  }
  return static_cast<int>(edge);
}

double read_fovy(const Value& value) {
  const double fovy = read_number(value);
  if (!(fovy > 0 && fovy < 180)) throw bad_value(value, "an angle between 0 and 180 degrees is needed");
  return fovy;
}

std::array<float, 3> read_three(const Value& value, double least, double largest) {
  const auto numbers = parse_numbers(value.text);
  if (!numbers || numbers->size() != 3) throw bad_value(value, "three numbers are needed");
  std::array<float, 3> three{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = (*numbers)[k];
    if (!(x >= least && x <= largest)) {
      throw bad_value(value, fmt::format("numbers from {:g} to {:g} are needed", least, largest));
    }
    three[k] = static_cast<float>(x);
  }
  return three;
}

Vec3 read_vector(const Value& value) {
  const auto [x, y, z] = read_three(value, -kMaxCoordinate, kMaxCoordinate);
  return {x, y, z};
}

Rgb read_radiance(const Value& value) {
  const auto [r, g, b] = read_three(value, 0, std::numeric_limits<float>::max());
  return {r, g, b};
}

class XmlReader {
 public:
  XmlReader(const std::filesystem::path& path, Warnings& warnings)
      : path_(path), warnings_(warnings), text_(read_text_file(path)) {}

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
      for (const pugi::xml_node node : document_.children(root)) read_elements(node);
    }
    if (!camera_) {
      throw SceneError({path_}, "there is no <camera>", fmt::format("for example {}", kCameraExample));
    }
    return std::move(scene_);
  }

 private:
  FilePosition position(std::ptrdiff_t offset) const {
    const std::string_view before =
        std::string_view(text_).substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    return {path_, static_cast<int>(line), static_cast<int>(before.size() - line_start + 1)};
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
      } else if (!root) {
        warn_unknown(node, fmt::format("<{}>", name));
      }
    }
  }

  void warn_unknown(const pugi::xml_node& node, const std::string& what) {
    if (unknown_.insert(what).second) warn(warnings_, position(node), what + " is unknown and left out");
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

  std::optional<Value> find(const pugi::xml_node& element, const char* name) const {
    const Property* property = find_property(element.name(), name);
    const pugi::xml_attribute attribute = element.attribute(name);
    const pugi::xml_node child = element.child(name);
    const pugi::xml_node second = attribute ? child : child.next_sibling(name);
    if (second)
      throw SceneError(position(second), fmt::format("{} is given twice", name), "keep one of them");
    if (attribute) return Value{property, attribute.value(), position(element)};
    if (child) return Value{property, text_of(child), position(child)};
    return std::nullopt;
  }

  Value require(const pugi::xml_node& element, const char* name) const {
    if (std::optional<Value> value = find(element, name)) return std::move(*value);
    throw SceneError(position(element), fmt::format("<{}> has no {}", element.name(), name),
                     example_of(*find_property(element.name(), name)));
  }

  void read_camera(const pugi::xml_node& element) {
    if (camera_) {
      throw SceneError(position(element),
                       fmt::format("a second <camera>; the first is in line {}", camera_->line),
                       "keep one of them");
    }
    camera_ = position(element);
    warn_of_unknown_properties(element);
    const std::optional<Value> type = find(element, "type");
    if (type && type->text != "perspective") throw bad_value(*type, "only perspective cameras are supported");
    scene_.view = {.eye = read_vector(require(element, "eye")),
                   .look_at = read_vector(require(element, "lookat")),
                   .up = read_vector(require(element, "up")),
                   .fovy = read_fovy(require(element, "fovy")),
                   .width = read_edge(require(element, "width")),
                   .height = read_edge(require(element, "height"))};
    check_directions(element);
  }

  void check_directions(const pugi::xml_node& camera) const {
    const Vec3d sight = Vec3d(scene_.view.look_at) - Vec3d(scene_.view.eye), up(scene_.view.up);
    if (sight == Vec3d(0)) {
      throw SceneError(require(camera, "lookat").where,
                       "lookat is the same point as eye: the camera looks nowhere",
                       "set lookat to a point in front of the camera");
    }
    if (!(length(cross(sight, up)) > kLeastSine * length(sight) * length(up))) {
      throw SceneError(require(camera, "up").where, "up is zero or along the line from eye to lookat",
                       "set up to the direction that is upwards in the image");
    }
  }

  void read_light(const pugi::xml_node& element) {
    warn_of_unknown_properties(element);
    const Value name = require(element, "mtlname");
    if (name.text.empty()) throw bad_value(name, "the name of a material is needed");
    const XmlLight light{name.text, read_radiance(require(element, "radiance")), position(element)};
    const auto same = std::find_if(scene_.lights.begin(), scene_.lights.end(),
                                   [&](const XmlLight& l) { return l.material == light.material; });
    if (same == scene_.lights.end()) return scene_.lights.push_back(light);
    warn(warnings_, light.where,
         fmt::format("light {} is given in line {} already; this one is used", in_quotes(name.text),
                     same->where.line));
    *same = light;
  }

  std::filesystem::path path_;
  Warnings& warnings_;
  std::string text_;
  pugi::xml_document document_;
  std::set<std::string> unknown_;  // what was warned of
  std::optional<FilePosition> camera_;
  XmlScene scene_;
};

}  // namespace

XmlScene read_xml(const std::filesystem::path& path, Warnings& warnings) {
  return XmlReader(path, warnings).read();
}

}  // namespace lemma
