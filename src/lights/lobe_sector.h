#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "src/core/elementary.h"
#include "src/core/pdf.h"
#include "src/core/reflection.h"
#include "src/core/warp.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/tangent.h"

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
    if (!may_serve(reflection, cone)) return std::nullopt;
    const LobeSector sector(reflection, cone);
    return sector.serves() ? std::optional(sector) : std::nullopt;
  }

  /// Not over a cone so much narrower than the lobe that directions uniform over it serve.
  /// @param peak, width    of the Reflection
  /// @param one_minus_cos  of the cone's half angle
  [[gnu::always_inline, nodiscard]] static bool may_serve(float peak, float width, float one_minus_cos) {
    constexpr float narrowest = 0.5f;
    return (peak != 0) & !(one_minus_cos < narrowest * width);
  }

  /// One that does not serve.
  LobeSector() = default;

  /// One that means nothing unless it serves; without branches.
  [[gnu::always_inline]] LobeSector(const Reflection& reflection, const SphereCone& cone)
      : mirror_(reflection.mirror), axis_(cone.axis()), width_(reflection.width) {
    const Vec3 axis(cone.axis());
    const auto cone_size = static_cast<float>(cone.one_minus_cos());
    const float width = reflection.width;

    // 1 - cos of the angles between mirror direction and axis, and of their sum and difference with the
    // cone's half angle.
    const Vec3 difference = axis - reflection.mirror;
    const float apart = std::min(0.5f * dot(difference, difference), 2.0f);
    const float sine = std::sqrt(apart * (2 - apart)), cone_sine = std::sqrt(cone_size * (2 - cone_size));
    const float middle = apart + cone_size - apart * cone_size, reach = sine * cone_sine;
    beside_ = apart > cone_size;
    const float inner = beside_ ? std::max(middle - reach, 0.0f) : 0.0f;
    const bool holds_opposite = apart + cone_size >= 2;
    const float outer = holds_opposite ? 2.0f : middle + reach;
    const bool turns_around = !beside_ | (cone_sine >= sine);
    const float half_turn = turns_around ? kPi : elementary::asin(cone_sine / sine);

    // Both ways of sampling waste a part of what they draw: the sector what misses the cone, if the outline's
    // mean over the cone is right; the cone where the lobe is dark: by the second moment of a lobe in its
    // middle, all but 2 / (2 + cone / lobe).
    const float fallen = elementary::decay((outer - inner) / width);
    const float mass = width * half_turn * (1 - fallen);  // of half the sector, over the density at its edge
    const float lobe = reflection.mean(axis, cone_size) - reflection.diffuse;
    const float kept = lobe * cone_size * kPi;
    const float drawn = reflection.peak * elementary::decay(inner / width) * mass;
    serves_ = may_serve(reflection, cone) & (kept * (2 * width + cone_size) > 2 * width * drawn);
    inner_ = inner, fallen_ = fallen, half_turn_ = half_turn;
    peak_density_ = 1 / (2 * double{mass});
    share_ = lobe / (lobe + reflection.diffuse);
  }

  /// Whether it serves better than directions uniform over the cone.
  [[gnu::always_inline, nodiscard]] bool serves() const { return serves_; }

  /// The part of the samples of the light that should be drawn here, the rest uniformly over the cone: that
  /// of the light that the lobe reflects; in (0, 1).
  [[gnu::always_inline, nodiscard]] double share() const { return share_; }

  /// Unit direction for u uniform in [0,1)^2; it may miss the cone.
  [[gnu::always_inline, nodiscard]] Vec3d sample(const Vec2& u) const {
    const double fallen_by = inner_ - width_ * elementary::log1p(double{u.x} * (fallen_ - 1));
    const double positive = fallen_by < 0 ? 0 : fallen_by, below = 2 < positive ? 2 : positive;  // 1 - cos
    const double sine = std::sqrt(below * (2 - below));
    const auto [sin_phi, cos_phi] =
        sin_cos_turn(half_turn_ * (0.5 * std::numbers::inv_pi) * (2 * double{u.y} - 1));
    const Vec3d across = normalize(cross(mirror_, axis_)), any = tangent(mirror_);
    const Vec3d t(beside_ ? across.x : any.x, beside_ ? across.y : any.y, beside_ ? across.z : any.z);
    const Vec3d s = cross(t, mirror_);
    return normalize(mirror_ * (1 - below) + (s * cos_phi + t * sin_phi) * sine);
  }

  /// Density with which sample() returns a unit direction of the cone.
  [[gnu::always_inline, nodiscard]] PdfSolidAngle pdf(const Vec3d& w) const {
    const Vec3d difference = w - mirror_;
    const double below = 0.5 * dot(difference, difference);
    return {static_cast<float>(peak_density_ * elementary::decay((below - inner_) / width_))};
  }

 private:
  [[gnu::always_inline, nodiscard]] static bool may_serve(const Reflection& reflection,
                                                          const SphereCone& cone) {
    return may_serve(reflection.peak, reflection.width, static_cast<float>(cone.one_minus_cos()));
  }

  Vec3d mirror_{0, 0, 1}, axis_{0, 0, 1};
  double width_ = 1;
  bool beside_ = false;  // the cone does not hold the mirror direction
  bool serves_ = false;
  // The sector: 1 - cos of the angle to the mirror direction from `inner_` on, to where the lobe has fallen
  // by `fallen_`; to both sides of the axis by `half_turn_` about the mirror direction.
  double inner_ = 0, fallen_ = 0, half_turn_ = 0;
  double peak_density_ = 0;  // at the inner edge
  double share_ = 0;
};

}  // namespace lemma
