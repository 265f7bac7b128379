#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/pdf.h"
#include "src/lights/connection.h"
#include "src/lights/emitter_view.h"

namespace lemma {

/// Two emitters of one light that make up a parallelogram: the rectangles that many scenes have as lights.
/// Seen from afar they are sampled as one, by area.
class QuadLight {
 public:
  /// @param halves  the emitters, each wound from the corner that the other does not have
  QuadLight(const std::array<std::uint32_t, 2>& emitters, const std::array<Triangle, 2>& halves,
            float radiance_luminance);

  [[nodiscard]] const std::array<std::uint32_t, 2>& emitters() const { return emitters_; }
  [[nodiscard]] const EmitterView& view() const { return view_; }

  /// A point for u uniform in [0,1)^2, which the parallelogram is an image of.
  struct Point {
    std::uint32_t emitter;
    Vec3d y;
  };
  [[nodiscard]] Point sample(const Vec2& u) const {
    const std::size_t half = half_of(u);
    return {emitters_[half], point_in(halves_[half], half, u)};
  }

  /// Density of the direction of a point on one of the two, times the probability `pmf` of the light.
  [[nodiscard]] PdfSolidAngle pdf(double pmf, std::uint32_t emitter, const Connection& connection) const {
    return pdf(pmf, densities_[emitter == emitters_[0] ? 0 : 1], connection);
  }

  // What these two do, step by step, without branches.

  /// The half that the point lies on.
  [[nodiscard]] static std::size_t half_of(const Vec2& u) { return double{u.x} + double{u.y} <= 1 ? 0 : 1; }
  [[nodiscard]] const std::array<Triangle, 2>& halves() const { return halves_; }
  /// By area, of each half: one half / area.
  [[nodiscard]] const std::array<double, 2>& densities() const { return densities_; }
  /// @param triangle  halves()[half]
  [[gnu::always_inline, nodiscard]] static Vec3d point_in(const Triangle& triangle, std::size_t half,
                                                          const Vec2& u) {
    const double s = u.x, t = u.y;
    return point_at(triangle, half == 0 ? s : 1 - s, half == 0 ? t : 1 - t);
  }
  [[gnu::always_inline, nodiscard]] static PdfSolidAngle pdf(double pmf, double density,
                                                             const Connection& connection) {
    return to_solid_angle({static_cast<float>(pmf * density)}, connection.distance2, connection.cos_light);
  }

 private:
  std::array<std::uint32_t, 2> emitters_;
  std::array<Triangle, 2> halves_;
  std::array<double, 2> densities_;
  EmitterView view_;
};

/// Finds pairs among the emitters that are `free`; no emitter is in two of them.
[[nodiscard]] std::vector<QuadLight> find_quad_lights(std::span<const Emitter> emitters,
                                                      const std::vector<bool>& free);

}  // namespace lemma
