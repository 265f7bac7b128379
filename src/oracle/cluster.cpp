#include "src/oracle/cluster.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <vector>

namespace lemma {
namespace {

/// An edge of a triangle beside the ray; equal ends make equal edges, whichever way they are wound.
struct Edge {
  Vec3 from, to;
  std::size_t member;  // index of the passage
  bool clear;          // the ray passes it on a certain side

  [[nodiscard]] auto key() const { return std::tuple(from.x, from.y, from.z, to.x, to.y, to.z); }
};

bool before(const Vec3& a, const Vec3& b) {
  return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
}

/// All edges, equal ones side by side. Comparison takes -0 for 0, as arithmetic does.
std::vector<Edge> sorted_edges(std::span<const Triangle> triangles, std::span<const Passage> near) {
  std::vector<Edge> edges;
  edges.reserve(3 * near.size());
  for (std::size_t m = 0; m < near.size(); ++m) {
    const Triangle& t = triangles[near[m].triangle];
    const std::array<Vec3, 3> v{t.v0, t.v1, t.v2};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = v[(i + 1) % 3], &b = v[(i + 2) % 3];
      edges.push_back(before(a, b) ? Edge{a, b, m, near[m].side[i] != 0}
                                   : Edge{b, a, m, near[m].side[i] != 0});
    }
  }
  std::ranges::sort(edges, {}, &Edge::key);
  return edges;
}

/// For each passage the first of its cluster: those joined across edges that are not clear.
class Clusters {
 public:
  Clusters(std::span<const Edge> edges, std::size_t members) : parent_(members) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t i = 1; i < edges.size(); ++i) {
      const Edge &a = edges[i - 1], &b = edges[i];
      if (a.key() == b.key() && !(a.clear && b.clear)) join(a.member, b.member);
    }
  }

  [[nodiscard]] std::size_t of(std::size_t member) const {
    while (parent_[member] != member) member = parent_[member];
    return member;
  }

 private:
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<std::size_t> parent_;
};

/// Whether the half-line from the ray along +x crosses an edge, in the coordinates of LongRay::beside. The
/// sides of the end points come out the same for all edges of a vertex, so that the parity of crossings of a
/// closed curve is that of its winding number.
bool crosses(const LongRay& ray, const Edge& edge) {
  const Vec3d a = ray.beside(edge.from), b = ray.beside(edge.to);
  if ((a.y > 0) == (b.y > 0)) return false;
  return (a.x * b.y - b.x * a.y > 0) == (b.y > a.y);
}

/// Whether the edges of a cluster that occur an odd number of times are clear of the ray and wind around it.
bool surrounds(const LongRay& ray, std::span<const Edge> edges, const Clusters& clusters,
               std::size_t cluster) {
  bool odd = false;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last =
        std::find_if(first, edges.end(), [&](const Edge& e) { return e.key() != first->key(); });
    const auto ours = [&](const Edge& e) { return clusters.of(e.member) == cluster; };
    if (std::count_if(first, last, ours) % 2 == 1) {
      if (std::any_of(first, last, [&](const Edge& e) { return ours(e) && !e.clear; })) return false;
      odd ^= crosses(ray, *first);
    }
    first = last;
  }
  return odd;
}

/// The t by which a cluster that surrounds the ray has been hit: that of its farthest triangle. Nothing if
/// one of them may lie beyond the ends of the range.
std::optional<double> hit_by(std::span<const Passage> near, const Clusters& clusters, std::size_t cluster) {
  double t = -std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < near.size(); ++m) {
    if (clusters.of(m) != cluster || near[m].inside == Passage::Answer::no) continue;
    if (near[m].in_range != Passage::Answer::yes) return std::nullopt;
    t = std::max(t, near[m].hi);
  }
  return t;
}

}  // namespace

double covered_by(const LongRay& ray, std::span<const Triangle> triangles, std::span<const Passage> near) {
  const std::vector<Edge> edges = sorted_edges(triangles, near);
  const Clusters clusters(edges, near.size());
  double reach = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < near.size(); ++m) {
    if (clusters.of(m) != m) continue;
    const std::optional<double> t = hit_by(near, clusters, m);
    if (t && *t < reach && surrounds(ray, edges, clusters, m)) reach = *t;
  }
  return reach;
}

}  // namespace lemma
