#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "src/core/triangle.h"

namespace lemma::test {

using Corners = std::array<Vec3d, 3>;

[[nodiscard]] Corners corners(const Triangle& t);

/// What a triangle covers of the unit sphere about x, computed with 50 digits.
[[nodiscard]] double exact_solid_angle(const Corners& triangle, const Vec3& x);

/// The integral of max(0, n . w) over it, likewise: Lambert's sum over the part above the horizon of n.
[[nodiscard]] double exact_projected_solid_angle(const Corners& triangle, const Vec3& x, const Vec3& n);

/// A triangle, from where and over which horizon it is seen.
struct SeenTriangle {
  std::string_view name;
  Triangle triangle;
  Vec3 x, n;
};

/// Those that break sampling and measuring: tiny, near a hemisphere, slivers, across the horizon, seen from
/// near the plane and an edge, with the zenith inside, on an edge and on a vertex.
[[nodiscard]] const std::vector<SeenTriangle>& hard_triangles();

/// A triangle cut into similar parts of about equal measure, for histograms of directions towards it.
class Partition {
 public:
  using Measure = double (*)(const Corners& part, const SeenTriangle& seen);
  /// Quarters the part of the largest measure again and again until there are `parts` or more.
  Partition(const SeenTriangle& seen, Measure measure, std::size_t parts);

  [[nodiscard]] std::vector<Corners> parts() const;
  /// Share of the measure that each part has.
  [[nodiscard]] std::vector<double> shares() const;
  [[nodiscard]] double total() const { return nodes_.front().measure; }
  /// The part that the direction w leads to; -1 if it misses the triangle by more than rounding.
  [[nodiscard]] int part_seen(const Vec3d& w) const;

 private:
  struct Node {
    Corners corners;
    double measure;
    int first_child = -1, part = -1;
  };
  SeenTriangle seen_;
  std::vector<Node> nodes_;
  std::size_t parts_ = 0;
};

[[nodiscard]] double area_of(const Corners& part, const SeenTriangle& seen);
[[nodiscard]] double solid_angle_of(const Corners& part, const SeenTriangle& seen);
[[nodiscard]] double projected_solid_angle_of(const Corners& part, const SeenTriangle& seen);

}  // namespace lemma::test
