#include "src/lights/quad_light.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace lemma {
namespace {

// How far the fourth corner may lie from where a parallelogram has it, over the longest edge. The halves are
// sampled with the same probability whatever their areas are, so this is a matter of quality alone.
constexpr float kSkew = 1e-3f;

using Corner = std::tuple<float, float, float>;
using Edge = std::pair<Corner, Corner>;

Corner corner_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

/// The same triangle, wound from corner k.
Triangle wound_from(const Triangle& t, std::size_t k) {
  if (k == 1) return {t.v1, t.v2, t.v0};
  if (k == 2) return {t.v2, t.v0, t.v1};
  return t;
}

/// The emitters by the edges opposite to their corners, in the direction of their winding.
class Neighbours {
 public:
  explicit Neighbours(std::span<const Emitter> emitters) {
    for (std::uint32_t e = 0; e < emitters.size(); ++e) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Triangle t = wound_from(emitters[e].shape, k);
        by_edge_.emplace(Edge(corner_of(t.v1), corner_of(t.v2)), std::pair(e, t));
      }
    }
  }

  /// The emitter beyond the edge opposite to v0, wound from the corner that the triangle does not have.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, Triangle>> across(const Triangle& t) const {
    const auto found = by_edge_.find(Edge(corner_of(t.v2), corner_of(t.v1)));
    return found == by_edge_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::map<Edge, std::pair<std::uint32_t, Triangle>> by_edge_;
};

bool is_parallelogram(const Triangle& a, const Triangle& b) {
  return length((a.v1 - a.v0) + (a.v2 - a.v0) - (b.v0 - a.v0)) <= kSkew * longest_edge(a);
}

EmitterView view_of(const std::array<Triangle, 2>& halves, float luminance) {
  const auto& [a, b] = halves;
  const float diagonal = std::max(length(a.v2 - a.v1), length(b.v0 - a.v0));
  return {(a.v1 + a.v2) * 0.5f, geometric_normal(a), diagonal,
          static_cast<float>(luminance * (area(a) + area(b)))};
}

}  // namespace

QuadLight::QuadLight(const std::array<std::uint32_t, 2>& emitters, const std::array<Triangle, 2>& halves,
                     float radiance_luminance)
    : emitters_(emitters),
      halves_(halves),
      densities_{0.5 / area(halves[0]), 0.5 / area(halves[1])},
      view_(view_of(halves, radiance_luminance)) {}

std::vector<QuadLight> find_quad_lights(std::span<const Emitter> emitters, const std::vector<bool>& free) {
  const Neighbours neighbours(emitters);
  std::vector<bool> left = free;
  std::vector<QuadLight> quads;
  for (std::uint32_t e = 0; e < emitters.size(); ++e) {
    for (std::size_t k = 0; k < 3 && left[e]; ++k) {
      const Triangle half = wound_from(emitters[e].shape, k);
      const auto other = neighbours.across(half);
      if (!other || other->first == e || !left[other->first]) continue;
      if (emitters[other->first].light != emitters[e].light || !is_parallelogram(half, other->second))
        continue;
      left[e] = left[other->first] = false;
      quads.push_back({{e, other->first}, {half, other->second}, luminance(emitters[e].radiance)});
    }
  }
  return quads;
}

}  // namespace lemma
