#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/lights/emitter.h"

namespace lemma {

/// Emitters that lie in the plane of another triangle and cover a part of it, such as a light let into a
/// ceiling. Which of the two a ray hits first is then decided by rounding, differently for camera rays, BRDF
/// samples and light samples and for every accelerator. The rule that makes it one scene for all: the emitter
/// is on top, and of several the one of the lowest index.
struct Overlays {
  std::vector<std::uint32_t> list_of;  // for each triangle its list in `lists`, or kNone; empty if no lists
  std::vector<std::vector<std::uint32_t>> lists;  // indices of the emitters on top, ascending

  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  [[nodiscard]] bool empty() const { return lists.empty(); }

  /// The emitters on top of a triangle.
  [[nodiscard]] std::span<const std::uint32_t> on(std::uint32_t triangle) const {
    const std::uint32_t list = list_of[triangle];
    return list == kNone ? std::span<const std::uint32_t>() : lists[list];
  }
};

/// Finds all overlays. In the plane means: nearer to it than the error of a hit from anywhere in the scene.
[[nodiscard]] Overlays find_overlays(std::span<const Triangle> triangles, std::span<const Emitter> emitters);

}  // namespace lemma
