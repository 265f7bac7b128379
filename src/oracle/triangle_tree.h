#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/bounds.h"
#include "src/oracle/passage.h"

namespace lemma {

/// Finds the triangles that a ray may hit, by boxes that are widened by more than any sound test can err
/// (kBoxBand). It shares nothing with the accelerators that the oracle judges: no file, no float arithmetic.
class TriangleTree {
 public:
  explicit TriangleTree(std::span<const Triangle> triangles);

  /// Calls visit(i) for every triangle whose widened box the ray's line meets, and that may hold a t in
  /// (t_min, t_max) up to `reach`, roughly the nearest first. `reach` is read again for every box.
  template <class Visit>
  void visit(const LongRay& ray, const double& reach, const Visit& visit) const;

 private:
  struct Node {
    Bounds box;
    std::uint32_t first = 0;  // of a leaf: its triangles in order_; else its children, first and first + 1
    std::uint32_t count = 0;  // of a leaf; else 0
  };
  static constexpr std::uint32_t kLeafSize = 4;

  /// Where a ray is in a widened box, along its largest axis.
  struct Passing {
    bool meets = false;
    double enter = 0, leave = 0;
  };
  [[nodiscard]] static Passing pass(const LongRay& ray, const Bounds& box);
  void split(std::uint32_t node, std::uint32_t first, std::uint32_t count);

  std::span<const Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

template <class Visit>
void TriangleTree::visit(const LongRay& ray, const double& reach, const Visit& visit) const {
  const auto may_hold = [&](const Passing& p) {
    return p.meets && p.leave >= ray.t_min && p.enter <= std::min(ray.t_max, reach);
  };
  struct Entry {
    std::uint32_t node;
    Passing passing;
  };
  std::array<Entry, 64> stack;  // a median split of 2^32 triangles is 32 deep
  std::size_t size = 0;
  if (!nodes_.empty()) stack[size++] = {0, pass(ray, nodes_[0].box)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (!may_hold(entry.passing)) continue;
    const Node& node = nodes_[entry.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      Bounds box;
      box.add(triangles_[order_[i]]);
      if (may_hold(pass(ray, box))) visit(order_[i]);
    }
    if (node.count > 0) continue;
    Entry near{node.first, pass(ray, nodes_[node.first].box)},
        far{node.first + 1, pass(ray, nodes_[node.first + 1].box)};
    if (far.passing.enter < near.passing.enter) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
}

}  // namespace lemma
