#include "src/lights/lobe_sector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/warp.h"
#include "src/lights/tangent.h"

namespace lemma {

std::optional<LobeSector> LobeSector::fit(const Reflection& reflection, const SphereCone& cone) {
  LobeSector sector(reflection, cone);
  const Vec3 axis(cone.axis());
  const auto cone_size = static_cast<float>(cone.one_minus_cos());
  const float width = reflection.width;

  // 1 - cos of the angles between mirror direction and axis, and of their sum and difference with the cone's
  // half angle.
  const Vec3 difference = axis - reflection.mirror;
  const float apart = std::min(0.5f * dot(difference, difference), 2.0f);
  const float sine = std::sqrt(apart * (2 - apart)), cone_sine = std::sqrt(cone_size * (2 - cone_size));
  const float middle = apart + cone_size - apart * cone_size, reach = sine * cone_sine;
  sector.beside_ = apart > cone_size;
  const float inner = sector.beside_ ? std::max(middle - reach, 0.0f) : 0.0f;
  const bool holds_opposite = apart + cone_size >= 2;
  const float outer = holds_opposite ? 2.0f : middle + reach;
  const bool turns_around = !sector.beside_ || cone_sine >= sine;
  const float half_turn = turns_around ? kPi : std::asin(cone_sine / sine);

  // Both ways of sampling waste a part of what they draw: the sector what misses the cone, if the outline's
  // mean over the cone is right; the cone where the lobe is dark: by the second moment of a lobe in its
  // middle, all but 2 / (2 + cone / lobe).
  const float fallen = std::exp((inner - outer) / width);
  const float mass = width * half_turn * (1 - fallen);  // of half the sector, over the density at its edge
  const float lobe = reflection.mean(axis, cone_size) - reflection.diffuse;
  const float kept = lobe * cone_size * kPi;
  const float drawn = reflection.peak * std::exp(-inner / width) * mass;
  if (!(kept * (2 * width + cone_size) > 2 * width * drawn)) return std::nullopt;
  sector.inner_ = inner, sector.fallen_ = fallen, sector.half_turn_ = half_turn;
  sector.peak_density_ = 1 / (2 * double{mass});
  sector.share_ = lobe / (lobe + reflection.diffuse);
  return sector;
}

Vec3d LobeSector::sample(const Vec2& u) const {
  const double below =
      std::clamp(inner_ - width_ * std::log1p(double{u.x} * (fallen_ - 1)), 0.0, 2.0);  // 1 - cos
  const double sine = std::sqrt(below * (2 - below));
  const auto [sin_phi, cos_phi] =
      sin_cos_turn(half_turn_ * (0.5 * std::numbers::inv_pi) * (2 * double{u.y} - 1));
  const Vec3d t = beside_ ? normalize(cross(mirror_, axis_)) : tangent(mirror_), s = cross(t, mirror_);
  return normalize(mirror_ * (1 - below) + (s * cos_phi + t * sin_phi) * sine);
}

PdfSolidAngle LobeSector::pdf(const Vec3d& w) const {
  const Vec3d difference = w - mirror_;
  const double below = 0.5 * dot(difference, difference);
  return {static_cast<float>(peak_density_ * std::exp((inner_ - below) / width_))};
}

}  // namespace lemma
