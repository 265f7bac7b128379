#include "tests/support/seen_triangles.h"

#include <algorithm>
#include <boost/multiprecision/cpp_dec_float.hpp>

namespace lemma::test {
namespace {

using Real = boost::multiprecision::cpp_dec_float_50;

struct Exact {
  Real x, y, z;
  Exact(const Real& a, const Real& b, const Real& c) : x(a), y(b), z(c) {}
  explicit Exact(const Vec3d& v) : x(v.x), y(v.y), z(v.z) {}
  friend Exact operator-(const Exact& a, const Exact& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Exact operator*(const Exact& a, const Real& s) { return {a.x * s, a.y * s, a.z * s}; }
};

Real dot(const Exact& a, const Exact& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Exact cross(const Exact& a, const Exact& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Real length(const Exact& a) {
  return sqrt(dot(a, a));
}

std::array<Exact, 3> seen_from(const Corners& t, const Vec3& x) {
  const Exact origin{Vec3d(x)};
  return {Exact(t[0]) - origin, Exact(t[1]) - origin, Exact(t[2]) - origin};
}

std::vector<Exact> above_horizon(const std::array<Exact, 3>& polygon, const Exact& n) {
  std::vector<Exact> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Real at_a = dot(n, a), at_b = dot(n, b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
      kept.push_back((a * at_b - b * at_a) * (1 / (at_b - at_a)));
    }
  }
  return kept;
}

}  // namespace

Corners corners(const Triangle& t) {
  return {Vec3d(t.v0), Vec3d(t.v1), Vec3d(t.v2)};
}

double exact_solid_angle(const Corners& triangle, const Vec3& x) {
  const auto [a, b, c] = seen_from(triangle, x);
  const Real la = length(a), lb = length(b), lc = length(c);
  const Real volume = abs(dot(a, cross(b, c)));
  if (volume == 0) return 0;
  return static_cast<double>(2 *
                             atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb));
}

double exact_projected_solid_angle(const Corners& triangle, const Vec3& x, const Vec3& n) {
  const Exact normal{Vec3d(n)};
  const auto v = above_horizon(seen_from(triangle, x), normal);
  Real sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Exact c = cross(v[i], v[(i + 1) % v.size()]);
    const Real size = length(c);
    if (size > 0) sum += atan2(size, dot(v[i], v[(i + 1) % v.size()])) * dot(normal, c) / size;
  }
  return static_cast<double>(abs(sum) / 2 / length(normal));
}

const std::vector<SeenTriangle>& hard_triangles() {
  const Vec3 o(0), up(0, 0, 1), tilted = Vec3(0.6f, 0, 0.8f);
  static const std::vector<SeenTriangle> cases{
      {"octant", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, o, normalize(Vec3(1, 1, 1))},
      {"octant on the horizon", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, o, up},
      {"zenith inside", {{5, 5, 1}, {-5, 5, 1}, {0, -7, 1}}, o, up},
      {"zenith on an edge", {{-1, 0, 2}, {2, 0, 2}, {0, 3, 2}}, o, up},
      {"zenith on a vertex", {{0, 0, 2}, {2, 0, 2}, {0, 3, 2}}, o, up},
      {"beside the zenith", {{1, 1, 2}, {2, 0.5f, 2}, {1.5f, 3, 1}}, o, up},
      {"one vertex below", {{1, 0, 1}, {2, 3, 1}, {1, 2, -0.7f}}, o, up},
      {"two vertices below", {{1, 0, 1}, {2, 3, -1}, {1, 2, -0.2f}}, o, up},
      {"a tip above", {{1, 0, 1e-3f}, {2, 3, -1}, {1, 2, -0.2f}}, o, up},
      {"zenith inside, one below", {{8, 1, -3}, {-5, 6, 1.5f}, {-2, -9, 1}}, o, up},
      {"zenith inside, two below", {{8, 7, -2}, {-7, 8, -2}, {-0.5f, -5, 3}}, o, up},
      {"low over the horizon", {{3, 0, 1e-3f}, {3, 1, 2e-3f}, {3.5f, 0.5f, 0.1f}}, o, up},
      {"1e-2", {{1, 0.5f, 0.7f}, {1.01f, 0.5f, 0.7f}, {1, 0.5f, 0.71f}}, o, up},
      {"1e-6 sr", {{1, 0.5f, 0.7f}, {1.002f, 0.5f, 0.7f}, {1, 0.501f, 0.702f}}, o, tilted},
      {"1e-9 sr", {{1, 0.5f, 0.7f}, {1.0001f, 0.5f, 0.7f}, {1, 0.49995f, 0.70005f}}, o, tilted},
      {"1e-11 sr", {{1, 0.5f, 0.7f}, {1.00001f, 0.5f, 0.7f}, {1, 0.499995f, 0.700005f}}, o, up},
      {"sliver 1e3", {{1, -1, 0.3f}, {1, 1, 0.4f}, {1, 0.001f, 0.3501f}}, o, up},
      {"sliver across the horizon", {{1, -1, -0.1f}, {1, 1, 0.2f}, {1, 0.002f, 0.0501f}}, o, up},
      {"strip close by", {{-50, 0.01f, 0.02f}, {50, 0.01f, 0.02f}, {0, 0.011f, 0.03f}}, o, up},
      {"near a hemisphere", {{900, -800, 1}, {100, 1200, 1}, {-1000, -700, 1}}, o, up},
      {"near a hemisphere, tilted", {{900, -800, 1}, {100, 1200, 1}, {-1000, -700, 1}}, o, tilted},
      {"nearer: height 0.1", {{900, -800, 0.1f}, {100, 1200, 0.1f}, {-1000, -700, 0.1f}}, o, up},
      {"nearer: height 0.01", {{900, -800, 0.01f}, {100, 1200, 0.01f}, {-1000, -700, 0.01f}}, o, tilted},
      {"nearer: height 0.001", {{900, -800, 1e-3f}, {100, 1200, 1e-3f}, {-1000, -700, 1e-3f}}, o, up},
      {"by the plane and an edge", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0.3f, 1e-3f, 1e-3f}, {0, 0.6f, -0.8f}},
      {"by the plane, beyond an edge", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0.3f, -1e-4f, 1e-3f}, {0, 1, 0}},
      {"by a vertex", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {1e-4f, 2e-4f, 1e-4f}, normalize(Vec3(1, 1, 0.1f))}};
  return cases;
}

double area_of(const Corners& part, const SeenTriangle&) {
  return 0.5 * lemma::length(lemma::cross(part[1] - part[0], part[2] - part[0]));
}

double solid_angle_of(const Corners& part, const SeenTriangle& seen) {
  return exact_solid_angle(part, seen.x);
}

double projected_solid_angle_of(const Corners& part, const SeenTriangle& seen) {
  return exact_projected_solid_angle(part, seen.x, seen.n);
}

Partition::Partition(const SeenTriangle& seen, Measure measure, std::size_t parts) : seen_(seen) {
  nodes_.push_back({corners(seen.triangle), measure(corners(seen.triangle), seen), -1, -1});
  const auto size = [](const Node& node) { return node.first_child < 0 ? node.measure : -1; };
  for (std::size_t leaves = 1; leaves < parts; leaves += 3) {
    const auto largest = std::ranges::max_element(nodes_, {}, size) - nodes_.begin();
    const auto [a, b, c] = nodes_[static_cast<std::size_t>(largest)].corners;
    const Vec3d ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    nodes_[static_cast<std::size_t>(largest)].first_child = static_cast<int>(nodes_.size());
    for (const Corners& part :
         {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{bc, ca, ab}}) {
      nodes_.push_back({part, measure(part, seen), -1, -1});
    }
  }
  for (Node& node : nodes_) {
    if (node.first_child < 0) node.part = static_cast<int>(parts_++);
  }
}

std::vector<Corners> Partition::parts() const {
  std::vector<Corners> parts;
  for (const Node& node : nodes_) {
    if (node.part >= 0) parts.push_back(node.corners);
  }
  return parts;
}

std::vector<double> Partition::shares() const {
  std::vector<double> shares;
  for (const Node& node : nodes_) {
    if (node.part >= 0) shares.push_back(node.measure / total());
  }
  return shares;
}

int Partition::part_seen(const Vec3d& w) const {
  // Barycentric coordinates are the volumes that w spans with the edges.
  const auto [v0, v1, v2] = nodes_.front().corners;
  const Vec3d x(seen_.x), a = v0 - x, b = v1 - x, c = v2 - x;
  // a, b, c can be large against the volume: differences keep digits.
  std::array<double, 3> weight{lemma::dot(w, lemma::cross(b, c - b)), lemma::dot(w, lemma::cross(c, a - c)),
                               lemma::dot(w, lemma::cross(a, b - a))};
  const double sum = weight[0] + weight[1] + weight[2];
  for (double& b_i : weight) b_i /= sum;
  const double least = std::min({weight[0], weight[1], weight[2]});
  if (!(least > -1e-6)) return -1;
  std::size_t index = 0;
  while (nodes_[index].first_child >= 0) {
    std::size_t child = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      if (weight[k] >= 0.5) child = k;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      // The middle part has its corners opposite to those of the whole.
      weight[k] = child == 3 ? 1 - 2 * weight[k] : 2 * weight[k] - (k == child ? 1 : 0);
    }
    index = static_cast<std::size_t>(nodes_[index].first_child) + child;
  }
  return nodes_[index].part;
}

}  // namespace lemma::test
