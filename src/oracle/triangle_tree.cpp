#include "src/oracle/triangle_tree.h"

#include <limits>
#include <numeric>

#include "src/core/error_bound.h"

namespace lemma {

TriangleTree::TriangleTree(std::span<const Triangle> triangles)
    : triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (triangles.empty()) return;
  nodes_.reserve(triangles.size());
  nodes_.emplace_back();
  split(0, 0, static_cast<std::uint32_t>(triangles.size()));
}

/// Makes the node of order_[first, first + count): halves it at the median centroid of the longest axis.
void TriangleTree::split(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  Bounds box, centroids;
  const auto centroid = [&](std::uint32_t i) {  // three times it
    return triangles_[i].v0 + triangles_[i].v1 + triangles_[i].v2;
  };
  const auto begin = order_.begin() + first, end = begin + count;
  for (auto i = begin; i != end; ++i) {
    box.add(triangles_[*i]);
    centroids.add(centroid(*i));
  }
  nodes_[node] = {box, first, count};
  if (count <= kLeafSize) return;
  const Vec3 size = centroids.hi - centroids.lo;
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, end,
                   [&](std::uint32_t a, std::uint32_t b) { return centroid(a)[axis] < centroid(b)[axis]; });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  split(children, first, half);
  split(children + 1, first + half, count - half);
}

TriangleTree::Passing TriangleTree::pass(const LongRay& ray, const Bounds& box) {
  const Vec3d lo = Vec3d(box.lo) - ray.origin, hi = Vec3d(box.hi) - ray.origin;
  const double margin = kBoxBand * kRoundoff * std::max(max_norm(lo), max_norm(hi));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double enter = -infinity, leave = infinity;
  Passing result;
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k];
    if (d == 0) {
      if (lo[k] - margin > 0 || hi[k] + margin < 0) return {};
      continue;
    }
    const double a = (lo[k] - margin) / d, b = (hi[k] + margin) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
    if (k == ray.kz) result.enter = std::min(a, b), result.leave = std::max(a, b);
  }
  result.meets = enter <= leave;
  return result;
}

}  // namespace lemma
