#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/rgb.h"
#include "src/scene/camera.h"
#include "src/scene/messages.h"

namespace lemma {

/// What a file needs at least, for messages.
inline constexpr std::string_view kCameraExample =
    R"(<camera width="1280" height="720" fovy="40"> <eye x="0" y="1" z="5"/> <lookat x="0" y="1" z="0"/>)"
    R"( <up x="0" y="1" z="0"/> </camera>)";
inline constexpr std::string_view kLightExample = R"(<light mtlname="NAME" radiance="17, 12, 4"/>)";

/// A light as the XML gives it: all faces of one material.
struct XmlLight {
  std::string material;
  Rgb radiance;  // >= 0
  FilePosition where;
};

/// A sphere of one material: most often a light.
struct XmlSphere {
  std::string material;
  Vec3 centre;
  double radius = 0;  // > 0
  FilePosition where;
};

struct XmlScene {
  CameraView view;
  std::vector<XmlLight> lights;  // each material once, in file order
  std::vector<XmlSphere> spheres;
  std::string dialect;  // how the file says it: "XML without root, attributes"
};

/// Reads camera, lights and spheres. A property may be an attribute (fovy="40"), a child with a value
/// (<fovy value="40"/>, <eye value="0, 1, 5"/>), a child with x, y, z, or a child with text; there may be no
/// root element, or a <scene> or <root>. A file that does not begin with '<' is read as plain text
/// (plain_scene.h). Elements and attributes that are not known are warned of. Of two lights with the same
/// material the later one counts, with a warning.
/// @throw SceneError with line and column (in bytes) for XML that is not well-formed, without camera, or with
///        values that make no image
[[nodiscard]] XmlScene read_xml(const std::filesystem::path& path, Warnings& warnings);

/// The same for a text that is in memory already.
/// @param path  what messages call it
[[nodiscard]] XmlScene parse_xml(const std::filesystem::path& path, std::string_view text,
                                 Warnings& warnings);

}  // namespace lemma
