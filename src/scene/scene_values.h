#pragma once

#include <string>
#include <string_view>

#include "src/core/rgb.h"
#include "src/scene/camera.h"
#include "src/scene/messages.h"

namespace lemma {

/// What a scene file has for a property of the camera or a light, and where. The checks below are those of
/// all dialects: each throws SceneError with the property's name, its text and an example.
struct SceneValue {
  std::string_view name;     // "fovy"
  std::string_view example;  // as this dialect writes it
  std::string text;
  FilePosition where;
};

/// @param what  what is wrong with the text
[[nodiscard]] SceneError bad_value(const SceneValue& value, std::string_view what);

[[nodiscard]] int to_edge(const SceneValue& value);       // of an image: a whole number from 1 to 65536
[[nodiscard]] double to_fovy(const SceneValue& value);    // in (0, 180) [degrees]
[[nodiscard]] Vec3 to_vector(const SceneValue& value);    // no coordinate beyond 1e18
[[nodiscard]] Rgb to_radiance(const SceneValue& value);   // three numbers from 0 to the largest float
[[nodiscard]] double to_length(const SceneValue& value);  // above 0, at most 1e18
void require_perspective(const SceneValue& type);
void require_name(const SceneValue& name);  // not empty

/// That the camera looks somewhere, and that up is not along the line of sight.
/// @param look_at, up  where the file says them
void require_directions(const CameraView& view, const FilePosition& look_at, const FilePosition& up);

}  // namespace lemma
