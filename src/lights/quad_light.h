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
  [[nodiscard]] Point sample(const Vec2& u) const;

  /// Density of the direction of a point on one of the two, times the probability `pmf` of the light.
  [[nodiscard]] PdfSolidAngle pdf(double pmf, std::uint32_t emitter, const Connection& connection) const;

 private:
  std::array<std::uint32_t, 2> emitters_;
  std::array<Triangle, 2> halves_;
  std::array<double, 2> density_;  // by area: one half / area
  EmitterView view_;
};

/// Finds pairs among the emitters that are `free`; no emitter is in two of them.
[[nodiscard]] std::vector<QuadLight> find_quad_lights(std::span<const Emitter> emitters,
                                                      const std::vector<bool>& free);

}  // namespace lemma
