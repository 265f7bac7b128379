#include "src/oracle/cluster.h"

#include <algorithm>
#include <limits>
#include <numeric>
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

/// Sets of passages that are joined; each is known by the first of its members.
class Clusters {
 public:
  explicit Clusters(std::size_t members) : parent_(members) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  [[nodiscard]] std::size_t of(std::size_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];  // halves the way for the next time
      member = parent_[member];
    }
    return member;
  }

  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// For each passage the first of its cluster: those joined across edges that are not clear.
std::vector<std::size_t> cluster_of_each(std::span<const Edge> edges, std::size_t members) {
  Clusters clusters(members);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const Edge &a = edges[i - 1], &b = edges[i];
    if (a.key() == b.key() && !(a.clear && b.clear)) clusters.join(a.member, b.member);
  }
  std::vector<std::size_t> cluster(members);
  for (std::size_t m = 0; m < members; ++m) cluster[m] = clusters.of(m);
  return cluster;
}

/// What a cluster does to the ray, as far as it has been looked at.
struct Cover {
  double t = -std::numeric_limits<double>::infinity();  // of the farthest triangle that may be hit
  bool in_range = true;                                 // no triangle may lie beyond the ends of the range
  bool clear = true;                                    // no edge of the curve around it is in doubt
  bool winds = false;                                   // and that curve winds around the ray

  [[nodiscard]] bool must_be_hit() const { return in_range && clear && winds; }
};

/// Whether the half-line from the ray along +x crosses an edge, in the coordinates of LongRay::beside. The
/// sides of the end points come out the same for all edges of a vertex, so that the parity of crossings of a
/// closed curve is that of its winding number.
bool crosses(const LongRay& ray, const Edge& edge) {
  const Vec3d a = ray.beside(edge.from), b = ray.beside(edge.to);
  if ((a.y > 0) == (b.y > 0)) return false;
  return (a.x * b.y - b.x * a.y > 0) == (b.y > a.y);
}

void add_triangles(std::span<const Passage> near, std::span<const std::size_t> cluster,
                   std::span<Cover> covers) {
  for (std::size_t m = 0; m < near.size(); ++m) {
    if (near[m].inside == Passage::Answer::no) continue;
    Cover& cover = covers[cluster[m]];
    cover.in_range &= near[m].in_range == Passage::Answer::yes;
    cover.t = std::max(cover.t, near[m].hi);
  }
}

/// The edges that occur an odd number of times in a cluster are the curve around it.
void add_curves(const LongRay& ray, std::span<Edge> edges, std::span<const std::size_t> cluster,
                std::span<Cover> covers) {
  const auto cluster_of = [&](const Edge& e) { return cluster[e.member]; };
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last =
        std::find_if(first, edges.end(), [&](const Edge& e) { return e.key() != first->key(); });
    std::ranges::sort(first, last, {}, cluster_of);
    while (first != last) {
      const auto next =
          std::find_if(first, last, [&](const Edge& e) { return cluster_of(e) != cluster_of(*first); });
      if ((next - first) % 2 == 1) {
        Cover& cover = covers[cluster_of(*first)];
        cover.clear &= std::all_of(first, next, [](const Edge& e) { return e.clear; });
        cover.winds ^= crosses(ray, *first);
      }
      first = next;
    }
  }
}

}  // namespace

double covered_by(const LongRay& ray, std::span<const Triangle> triangles, std::span<const Passage> near) {
  std::vector<Edge> edges = sorted_edges(triangles, near);
  const std::vector<std::size_t> cluster = cluster_of_each(edges, near.size());
  std::vector<Cover> covers(near.size());
  add_triangles(near, cluster, covers);
  add_curves(ray, edges, cluster, covers);
  double reach = std::numeric_limits<double>::infinity();
  for (const Cover& cover : covers) {
    if (cover.must_be_hit()) reach = std::min(reach, cover.t);
  }
  return reach;
}

}  // namespace lemma
