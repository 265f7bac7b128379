#pragma once

#include "src/lights/lobe_sector.h"
#include "src/lights/sphere_cone.h"

namespace lemma {

/// A whole light as seen from a point: directions uniform over the cone of its bounding sphere, or drawn by
/// the lobe of the surface there. Without branches, for loops over points.
class WholeView {
 public:
  /// @param lobe  of the cone
  [[gnu::always_inline]] WholeView(const SphereCone& cone, const LobeSector& lobe)
      : cone_(cone), lobe_(lobe) {}

  /// A direction means nothing unless it lies within the cone.
  struct Direction {
    bool within;
    Vec3d w;  // unit
  };

  /// For u uniform in [0, 1)^2.
  [[gnu::always_inline, nodiscard]] Direction sample(double u, float v) const {
    const double share = lobe_.serves() ? lobe_.share() : 0;
    const bool by_lobe = u < share;
    const float rest = rest_of_choice(u, share, by_lobe);
    const Vec3d lobe = lobe_.sample({rest, v}), cone = cone_.sample({rest, v});
    const Vec3d w(by_lobe ? lobe.x : cone.x, by_lobe ? lobe.y : cone.y, by_lobe ? lobe.z : cone.z);
    const bool within = !by_lobe | cone_.holds(w);
    return {within, w};
  }

  /// Times the probability `pmf` of the light.
  /// @param to_light  within the cone
  [[gnu::always_inline, nodiscard]] PdfSolidAngle pdf(double pmf, const Vec3d& to_light) const {
    const double uniform = 1 / cone_.solid_angle();
    const double share = lobe_.share(), by_lobe = lobe_.pdf(normalize(to_light)).value;
    const double density = lobe_.serves() ? (1 - share) * uniform + share * by_lobe : uniform;
    return {static_cast<float>(pmf * density)};
  }

 private:
  SphereCone cone_;
  LobeSector lobe_;
};

}  // namespace lemma
