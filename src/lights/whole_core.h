#pragma once

#include <limits>

#include "src/lights/whole_light.h"

namespace lemma {

/// What is known without tracing of a ray x + t w that passes the core of a whole light: it meets the light,
/// and its front, unless something blocks it before the shell, a larger sphere in which nothing else lies.
///
/// Computed hits lie off by up to kPlaneError u M (src/core/error_bound.h), here less than 4.9e-4 core, since
/// x is at most kFarthest cores away. That is a quarter of what the core is smaller than the body, and less
/// than a twentieth of what the shell is larger: so the light itself is never found before the shell where
/// the ray meets it at cosines above 0.05.
struct WholeCore {
  static constexpr double kFarthest = 1000;         // in radii of the core
  static constexpr double kInside = 1 - 1.0 / 512;  // radius of the core over that of a ball in the body
  static constexpr double kSmallestShell = 1.01;    // over the radius of the light
  static constexpr double kClear = 1.01;            // what is clear over the radius of the shell

  Vec3d centre;
  double core, shell;  // of the WholeLight

  /// What the ray hits at t in (0, that) hides the light: where it enters the shell, 0 if x lies within.
  /// Infinity if it may pass the light by.
  /// @param x  outside of the light's sphere by so much that it can be sampled (SphereCone::can_be_sampled)
  [[gnu::always_inline, nodiscard]] float visible_until(const Vec3& x, const Vec3& w) const {
    const Vec3d to_centre = centre - Vec3d(x), along(w);
    const double distance2 = dot(to_centre, to_centre), length2 = dot(along, along);
    const double nearest = dot(to_centre, along) / length2;  // t there
    const double apart2 = distance2 - nearest * nearest * length2;
    const double core2 = core * core;
    const bool is_sure = (apart2 < core2) & (distance2 < kFarthest * kFarthest * core2);
    const double half_chord = std::sqrt(std::max(shell * shell - apart2, 0.0) / length2);
    const auto until = static_cast<float>(std::max(nearest - half_chord, 0.0));
    return is_sure ? until : std::numeric_limits<float>::infinity();
  }
};

}  // namespace lemma
