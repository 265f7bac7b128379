#pragma once

#include "src/lights/lobe_sector.h"
#include "src/lights/sphere_cone.h"

namespace lemma {

/// A whole light as seen from a point: directions uniform over the cone of its bounding sphere, or drawn by
/// the lobe of the surface there. In loops over points compilers turn its branches into selects.
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
    Vec3d w;
    if (by_lobe) {
      w = lobe_.sample({rest, v});
    } else {
      w = cone_.sample({rest, v});
    }
    const bool within = !by_lobe | cone_.holds(w);
    return {within, w};
  }

  /// Times the probability `pmf` of the light.
  /// @param to_light  within the cone
  [[gnu::always_inline, nodiscard]] PdfSolidAngle pdf(double pmf, const Vec3d& to_light) const {
    const double uniform = 1 / cone_.solid_angle();
    double density = uniform;
    if (lobe_.serves()) {
      const double share = lobe_.share(), by_lobe = lobe_.pdf(normalize(to_light)).value;
      density = (1 - share) * uniform + share * by_lobe;
    }
    return {static_cast<float>(pmf * density)};
  }

 private:
  SphereCone cone_;
  LobeSector lobe_;
};

}  // namespace lemma
