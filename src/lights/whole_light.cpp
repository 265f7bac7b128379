#include "src/lights/whole_light.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "src/core/bounds.h"
#include "src/lights/whole_core.h"

namespace lemma {
namespace {

constexpr double kSmallestFill = 0.5;
// The sphere is larger by what rounding may move a direction to its rim.
constexpr double kRim = 1 + 1e-6;

using Corner = std::tuple<std::uint32_t, float, float, float>;  // light and position

std::array<Corner, 3> corners(const Emitter& e) {
  const auto corner = [&](const Vec3& v) { return Corner(e.light, v.x, v.y, v.z); };
  return {corner(e.shape.v0), corner(e.shape.v1), corner(e.shape.v2)};
}

/// Sets of elements that can be united (union-find with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t root_of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[root_of(a)] = root_of(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The emitters of one light that hang together by common vertices.
std::vector<std::vector<std::uint32_t>> connected_parts(std::span<const Emitter> emitters) {
  DisjointSets sets(emitters.size());
  std::map<Corner, std::uint32_t> first_at;
  for (std::uint32_t e = 0; e < emitters.size(); ++e) {
    for (const Corner& c : corners(emitters[e])) sets.unite(e, first_at.try_emplace(c, e).first->second);
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
  for (std::uint32_t e = 0; e < emitters.size(); ++e) parts[sets.root_of(e)].push_back(e);
  std::vector<std::vector<std::uint32_t>> list;
  list.reserve(parts.size());
  for (auto& [root, part] : parts) list.push_back(std::move(part));
  return list;
}

bool is_closed(std::span<const Emitter> emitters, const std::vector<std::uint32_t>& part) {
  std::set<std::pair<Corner, Corner>> edges;
  for (const std::uint32_t e : part) {
    const auto c = corners(emitters[e]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edges.emplace(c[k], c[(k + 1) % 3]).second) return false;
    }
  }
  return std::ranges::all_of(edges, [&](const auto& edge) {
    return edges.contains({edge.second, edge.first});
  });
}

/// The least part of its bounding sphere's silhouette that a body of this part of the sphere's volume covers,
/// from any direction: a cylinder cut out of the sphere along that direction holds more than any other body
/// of its silhouette, and one that covers the part a of it holds 1 - (1 - a)^(3/2) of the sphere.
double smallest_fill(double volume_ratio) {
  return 1 - std::cbrt((1 - volume_ratio) * (1 - volume_ratio));
}

std::optional<WholeLight> as_whole(std::span<const Emitter> emitters, std::vector<std::uint32_t> part) {
  if (!is_closed(emitters, part)) return std::nullopt;
  Bounds box;
  for (const std::uint32_t e : part) box.add(emitters[e].shape);
  WholeLight light;
  light.centre = (Vec3d(box.lo) + Vec3d(box.hi)) * 0.5;
  double volume = 0, inscribed = std::numeric_limits<double>::infinity();
  for (const std::uint32_t e : part) {
    const Triangle& t = emitters[e].shape;
    const double pyramid = dot(Vec3d(t.v0) - light.centre, area_vector(t)) / 6;
    if (!(pyramid > 0)) return std::nullopt;  // faces the centre
    volume += pyramid;
    inscribed = std::min(inscribed, 6 * pyramid / length(area_vector(t)));
    for (const Vec3& v : {t.v0, t.v1, t.v2}) {
      light.radius = std::max(light.radius, length(Vec3d(v) - light.centre));
    }
  }
  const double sphere = 4 * std::numbers::pi / 3 * light.radius * light.radius * light.radius;
  if (smallest_fill(std::min(volume / sphere, 1.0)) < kSmallestFill) return std::nullopt;
  light.radius *= kRim;
  light.core = inscribed * WholeCore::kInside;
  light.emitters = std::move(part);
  return light;
}

/// How far a triangle is from a point at least: as far as its box, or its plane.
double least_distance(const Triangle& t, const Vec3d& from) {
  Bounds box;
  box.add(t);
  Vec3d apart;
  for (int k = 0; k < 3; ++k) apart[k] = std::max({box.lo[k] - from[k], from[k] - box.hi[k], 0.0});
  const Vec3d normal = area_vector(t);
  const double twice_area = length(normal);
  const double from_plane = twice_area > 0 ? std::abs(dot(Vec3d(t.v0) - from, normal)) / twice_area : 0;
  return std::max(length(apart), from_plane);
}

/// Finds the shells; a light that has something else near loses its core, as do all where there are so many
/// that finding them would take long.
void find_shells(std::span<const Emitter> emitters, std::span<const Triangle> triangles,
                 std::vector<WholeLight>& lights) {
  constexpr std::size_t most_pairs = 100'000'000;  // half a second
  const bool are_too_many = lights.size() * triangles.size() > most_pairs;
  for (WholeLight& light : lights) {
    if (are_too_many) {
      light.core = 0;
      continue;
    }
    std::vector<bool> own(triangles.size());
    for (const std::uint32_t e : light.emitters) {
      if (!triangles.empty()) own[emitters[e].triangle] = true;
    }
    double clear = WholeCore::kFarthest * light.radius;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (!own[i]) clear = std::min(clear, least_distance(triangles[i], light.centre));
    }
    light.shell = clear / WholeCore::kClear;
    if (light.shell < WholeCore::kSmallestShell * light.radius) light.core = light.shell = 0;
  }
}

}  // namespace

std::vector<WholeLight> find_whole_lights(std::span<const Emitter> emitters,
                                          std::span<const Triangle> triangles) {
  std::vector<WholeLight> lights;
  for (auto& part : connected_parts(emitters)) {
    if (auto light = as_whole(emitters, std::move(part))) lights.push_back(std::move(*light));
  }
  find_shells(emitters, triangles, lights);
  return lights;
}

}  // namespace lemma
