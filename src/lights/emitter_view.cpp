#include "src/lights/emitter_view.h"

#include <cmath>

namespace lemma {

float longest_edge(const Triangle& t) {
  return std::max({length(t.v1 - t.v0), length(t.v2 - t.v1), length(t.v0 - t.v2)});
}

EmitterView::EmitterView(const Emitter& emitter)
    : centre_(point_at(emitter.shape, 1 / 3.0, 1 / 3.0)),
      normal_(geometric_normal(emitter.shape)),
      power_(static_cast<float>(double{luminance(emitter.radiance)} * area(emitter.shape))) {
  size_ = longest_edge(emitter.shape);
  far_ = kFar * size_;
  aside2_ = kAside * kAside * size_ * size_;
}

/// The solid angle by the formula of SphericalTriangle, the cosine as the mean of max(0, cosine) at the
/// vertices.
double near_importance(const Emitter& emitter, const Vec3& x, const Vec3& n) {
  constexpr float least = 1e-30f;  // nothing that can be seen underflows to 0
  const double side = side_of(emitter.shape, x);
  if (!(side > 0)) return 0;
  const Vec3 a = emitter.shape.v0 - x, b = emitter.shape.v1 - x, c = emitter.shape.v2 - x;
  const float la = length(a), lb = length(b), lc = length(c);
  const auto cosine = [&](const Vec3& v, float size) {
    return std::max(dot(n, v) / size + EmitterView::kSlack, 0.0f);
  };
  const float cosines = cosine(a, la) + cosine(b, lb) + cosine(c, lc);
  if (cosines == 0) return 0;
  const float solid_angle = 2 * std::atan2(std::max(static_cast<float>(side), least),
                                           la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  return double{luminance(emitter.radiance)} * std::max(solid_angle, least) * (cosines / 3);
}

}  // namespace lemma
