#pragma once

#include "src/core/ray.h"

namespace lemma {

/// Where a perspective camera stands and what it sees, as scene files say it.
struct CameraView {
  Vec3 eye, look_at, up;
  double fovy = 0;  // vertical field of view [degrees], in (0, 180)
  int width = 0, height = 0;
};

/// Pinhole camera: its rays leave the eye through the pixels of a width x height image, row 0 at the top.
class Camera {
 public:
  /// @param view  look_at differs from eye, up is not parallel to the line between them
  explicit Camera(const CameraView& view);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// The ray through (x, y) of the image plane, in pixels from the upper left corner; unit direction.
  [[nodiscard]] Ray ray_through(float x, float y) const {
    return {.origin = eye_, .direction = direction_through(x, y)};
  }
  /// That ray's direction.
  [[nodiscard]] Vec3 direction_through(float x, float y) const {
    return Vec3(normalize(corner_ + step_x_ * static_cast<double>(x) + step_y_ * static_cast<double>(y)));
  }
  [[nodiscard]] const Vec3& eye() const { return eye_; }

 private:
  Vec3 eye_;
  Vec3d corner_, step_x_, step_y_;  // direction = corner + x step_x + y step_y
  int width_, height_;
};

}  // namespace lemma
