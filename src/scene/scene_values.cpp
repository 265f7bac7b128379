#include "src/scene/scene_values.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "src/scene/numbers.h"

namespace lemma {
namespace {

constexpr double kLargestEdge = 65536;  // of an image [pixels]
constexpr double kLeastSine = 1e-6;     // of the angle between up and the line of sight

double to_number(const SceneValue& value) {
  const auto numbers = parse_numbers(value.text);
  if (!numbers || numbers->size() != 1) throw bad_value(value, "a number is needed");
  return numbers->front();
}

std::array<float, 3> to_three(const SceneValue& value, double least, double largest) {
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

}  // namespace

SceneError bad_value(const SceneValue& value, std::string_view what) {
  return {value.where, fmt::format("{} is {}: {}", value.name, in_quotes(value.text), what),
          fmt::format("for example {}", value.example)};
}

int to_edge(const SceneValue& value) {
  const double edge = to_number(value);
  if (!(edge >= 1 && edge <= kLargestEdge && edge == std::floor(edge))) {
    throw bad_value(value, "a whole number from 1 to 65536 is needed");
  }
  return static_cast<int>(edge);
}

double to_fovy(const SceneValue& value) {
  const double fovy = to_number(value);
  if (!(fovy > 0 && fovy < 180)) throw bad_value(value, "an angle between 0 and 180 degrees is needed");
  return fovy;
}

Vec3 to_vector(const SceneValue& value) {
  const auto [x, y, z] = to_three(value, -kMaxCoordinate, kMaxCoordinate);
  return {x, y, z};
}

Rgb to_radiance(const SceneValue& value) {
  const auto [r, g, b] = to_three(value, 0, std::numeric_limits<float>::max());
  return {r, g, b};
}

double to_length(const SceneValue& value) {
  const double length = to_number(value);
  if (!(length > 0 && length <= kMaxCoordinate)) {
    throw bad_value(value, "a number above 0, at most 1e+18, is needed");
  }
  return length;
}

void require_perspective(const SceneValue& type) {
  if (type.text != "perspective") throw bad_value(type, "only perspective cameras are supported");
}

void require_name(const SceneValue& name) {
  if (name.text.empty()) throw bad_value(name, "the name of a material is needed");
}

void require_directions(const CameraView& view, const FilePosition& look_at, const FilePosition& up) {
  const Vec3d sight = Vec3d(view.look_at) - Vec3d(view.eye), upwards(view.up);
  if (sight == Vec3d(0)) {
    throw SceneError(look_at, "lookat is the same point as eye: the camera looks nowhere",
                     "set lookat to a point in front of the camera");
  }
  if (!(length(cross(sight, upwards)) > kLeastSine * length(sight) * length(upwards))) {
    throw SceneError(up, "up is zero or along the line from eye to lookat",
                     "set up to the direction that is upwards in the image");
  }
}

}  // namespace lemma
