#include "src/scene/overlays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "src/core/bounds.h"
#include "src/core/error_bound.h"

namespace lemma {
namespace {

/// Largest distance from the plane of `t` to a vertex of `other`.
double distance_from_plane(const Triangle& t, const Triangle& other) {
  const Vec3d normal = normalize(area_vector(t)), v0(t.v0);
  return std::max({std::abs(dot(normal, Vec3d(other.v0) - v0)), std::abs(dot(normal, Vec3d(other.v1) - v0)),
                   std::abs(dot(normal, Vec3d(other.v2) - v0))});
}

struct Interval {
  double lo, hi;
};

Interval extent_along(const Vec3d& axis, const Triangle& t) {
  const double a = dot(axis, Vec3d(t.v0)), b = dot(axis, Vec3d(t.v1)), c = dot(axis, Vec3d(t.v2));
  return {std::min({a, b, c}), std::max({a, b, c})};
}

/// Whether two triangles of one plane share an area, not just an edge: no edge of the first separates them.
bool edges_do_not_separate(const Triangle& a, const Triangle& b, double tolerance) {
  const Vec3d normal = normalize(area_vector(a));
  const std::array<Vec3d, 3> corners{Vec3d(a.v0), Vec3d(a.v1), Vec3d(a.v2)};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d across = normalize(cross(normal, corners[(i + 1) % 3] - corners[i]));
    const Interval of_a = extent_along(across, a), of_b = extent_along(across, b);
    if (std::min(of_a.hi, of_b.hi) - std::max(of_a.lo, of_b.lo) <= tolerance) return false;
  }
  return true;
}

bool overlap_in_plane(const Triangle& a, const Triangle& b, double tolerance) {
  return distance_from_plane(a, b) <= tolerance && edges_do_not_separate(a, b, tolerance) &&
         edges_do_not_separate(b, a, tolerance);
}

/// The triangles sorted by where they begin along an axis, to visit those near an emitter without trying all.
class Sweep {
 public:
  Sweep(std::span<const Triangle> triangles, int axis, double margin)
      : triangles_(triangles), axis_(axis), margin_(static_cast<float>(margin)) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const Bounds box = bounds_of(triangles.subspan(i, 1));
      longest_ = std::max(longest_, box.hi[axis] - box.lo[axis]);
      begins_.emplace_back(box.lo[axis], i);
    }
    std::ranges::sort(begins_);
  }

  /// Calls visit(triangle) for all whose bounding boxes touch that of `t`, margin included.
  template <class Visit>
  void for_each_near(const Triangle& t, const Visit& visit) const {
    const Bounds box = bounds_of({&t, 1});
    const float first = box.lo[axis_] - longest_ - margin_, last = box.hi[axis_] + margin_;
    for (auto it = std::ranges::lower_bound(begins_, std::pair(first, 0u));
         it != begins_.end() && it->first <= last; ++it) {
      if (touch(box, bounds_of(triangles_.subspan(it->second, 1)))) visit(it->second);
    }
  }

 private:
  [[nodiscard]] bool touch(const Bounds& a, const Bounds& b) const {
    for (int k = 0; k < 3; ++k) {
      if (a.lo[k] > b.hi[k] + margin_ || b.lo[k] > a.hi[k] + margin_) return false;
    }
    return true;
  }

  std::span<const Triangle> triangles_;
  int axis_;
  float margin_, longest_ = 0;
  std::vector<std::pair<float, std::uint32_t>> begins_;  // lower bound along the axis, triangle
};

int longest_axis(const Vec3& size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

Overlays find_overlays(std::span<const Triangle> triangles, std::span<const Emitter> emitters) {
  const Bounds box = bounds_of(triangles);
  const Vec3 size = box.hi - box.lo;
  const double tolerance = kPlaneError * kRoundoff * length(Vec3d(size));
  const Sweep sweep(triangles, longest_axis(size), tolerance);

  std::map<std::uint32_t, std::uint32_t> emitter_of;  // by triangle
  for (std::uint32_t e = 0; e < emitters.size(); ++e) emitter_of[emitters[e].triangle] = e;
  std::map<std::uint32_t, std::vector<std::uint32_t>> on_top;  // by triangle
  for (std::uint32_t e = 0; e < emitters.size(); ++e) {
    sweep.for_each_near(emitters[e].shape, [&](std::uint32_t t) {
      const auto other = emitter_of.find(t);
      if (other != emitter_of.end() && other->second <= e) return;
      if (overlap_in_plane(triangles[t], emitters[e].shape, tolerance)) on_top[t].push_back(e);
    });
  }

  Overlays overlays;
  if (on_top.empty()) return overlays;
  overlays.list_of.assign(triangles.size(), Overlays::kNone);
  for (auto& [triangle, list] : on_top) {
    overlays.list_of[triangle] = static_cast<std::uint32_t>(overlays.lists.size());
    overlays.lists.push_back(std::move(list));
  }
  return overlays;
}

}  // namespace lemma
