#pragma once

#include <optional>

#include "src/core/pdf.h"
#include "src/core/reflection.h"
#include "src/lights/sphere_cone.h"

namespace lemma {

/// Directions to a light within a cone, drawn by the lobe of the surface that looks at it: by
/// exp(-(1 - cos) / width) about the mirror direction, within a sector of a ring about that direction that
/// encloses the cone. So narrow a lobe that it shows the light's image, or its flank alone if it lies beside
/// the light, is sampled well, which directions uniform over the cone do not, and the BRDF's own only if the
/// light covers most of the lobe.
class LobeSector {
 public:
  /// @return nothing where directions uniform over the cone serve better
  [[nodiscard]] static std::optional<LobeSector> find(const Reflection& reflection, const SphereCone& cone) {
    // So it is over a cone so much narrower than the lobe.
    constexpr float narrowest = 0.5f;
    const auto cone_size = static_cast<float>(cone.one_minus_cos());
    if (reflection.peak == 0 || cone_size < narrowest * reflection.width) return std::nullopt;
    return fit(reflection, cone);
  }

  /// The part of the samples of the light that should be drawn here, the rest uniformly over the cone: that
  /// of the light that the lobe reflects; in (0, 1).
  [[nodiscard]] double share() const { return share_; }

  /// Unit direction for u uniform in [0,1)^2; it may miss the cone.
  [[nodiscard]] Vec3d sample(const Vec2& u) const;

  /// Density with which sample() returns a unit direction of the cone.
  [[nodiscard]] PdfSolidAngle pdf(const Vec3d& w) const;

 private:
  LobeSector(const Reflection& reflection, const SphereCone& cone)
      : mirror_(reflection.mirror), axis_(cone.axis()), width_(reflection.width) {}
  static std::optional<LobeSector> fit(const Reflection& reflection, const SphereCone& cone);

  Vec3d mirror_, axis_;
  double width_;
  bool beside_ = false;  // the cone does not hold the mirror direction
  // The sector: 1 - cos of the angle to the mirror direction from `inner_` on, to where the lobe has fallen
  // by `fallen_`; to both sides of the axis by `half_turn_` about the mirror direction.
  double inner_ = 0, fallen_ = 0, half_turn_ = 0;
  double peak_density_ = 0;  // at the inner edge
  double share_ = 0;
};

}  // namespace lemma
