#include "src/scene/camera.h"

#include <numbers>

namespace lemma {

Camera::Camera(const CameraView& view) : eye_(view.eye), width_(view.width), height_(view.height) {
  const Vec3d forward = normalize(Vec3d(view.look_at) - Vec3d(view.eye));
  const Vec3d right = normalize(cross(forward, Vec3d(view.up)));
  const Vec3d up = cross(right, forward);
  const double half_height = std::tan(view.fovy * std::numbers::pi / 360.0);
  const double pixel = 2 * half_height / height_;
  step_x_ = right * pixel;
  step_y_ = up * -pixel;
  corner_ = forward + right * (-0.5 * width_ * pixel) + up * half_height;
}

}  // namespace lemma
