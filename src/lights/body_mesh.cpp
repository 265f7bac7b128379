#include "src/lights/body_mesh.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "src/core/bounds.h"
#include "src/lights/body_trace.h"

namespace lemma {
namespace {

using Members = std::span<std::uint32_t>;

float middle(const Triangle& t, int axis) {
  return t.v0[axis] + t.v1[axis] + t.v2[axis];
}

/// Sorts members into two halves along the longest side of the box around their middles.
std::pair<Members, Members> halves(Members members, std::span<const Emitter> emitters) {
  const auto at = [&](std::uint32_t e, int axis) { return middle(emitters[e].shape, axis); };
  Bounds box;
  for (const std::uint32_t e : members) box.add(Vec3(at(e, 0), at(e, 1), at(e, 2)));
  const Vec3 sides = box.hi - box.lo;
  const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
  const std::size_t half = members.size() / 2;
  std::ranges::nth_element(members, members.begin() + static_cast<std::ptrdiff_t>(half),
                           [&](std::uint32_t a, std::uint32_t b) {
                             return std::pair(at(a, axis), a) < std::pair(at(b, axis), b);
                           });
  return {members.first(half), members.subspan(half)};
}

}  // namespace

BodyMesh::BodyMesh(std::span<const Emitter> all_emitters, const WholeLight& light)
    : emitters(all_emitters),
      walk(ConvexWalk::find(all_emitters, light)),
      centre(light.centre),
      radius(light.radius) {
  std::vector<std::uint32_t> members = light.emitters;
  root = build(members);
}

std::uint32_t BodyMesh::build(Members members) {
  if (members.size() <= kWidth) return add_leaf(members);
  std::vector<Members> parts{members};
  while (parts.size() < kWidth) {
    const auto largest = std::ranges::max_element(parts, {}, &Members::size);
    if (largest->size() <= kWidth) break;
    const auto [first, second] = halves(*largest, emitters);
    *largest = first;
    parts.push_back(second);
  }
  const auto index = static_cast<std::uint32_t>(inners.size());
  Inner node;
  for (Values& values : node.lo) values.fill(std::numeric_limits<float>::infinity());
  for (Values& values : node.hi) values.fill(-std::numeric_limits<float>::infinity());
  inners.push_back(node);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Bounds box;
    for (const std::uint32_t e : parts[i]) box.add(emitters[e].shape);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      node.lo[axis][i] = static_cast<float>(box.lo[k] - centre[k]);
      node.hi[axis][i] = static_cast<float>(box.hi[k] - centre[k]);
    }
    node.child[i] = build(parts[i]);
  }
  inners[index] = node;
  return index;
}

std::uint32_t BodyMesh::add_leaf(std::span<const std::uint32_t> members) {
  Leaf leaf;
  for (std::size_t i = 0; i < kWidth; ++i) {
    leaf.emitter[i] = members[std::min(i, members.size() - 1)];
    const Triangle& t = emitters[leaf.emitter[i]].shape;
    std::size_t value = 0;
    for (const Vec3& v : {t.v0, t.v1, t.v2}) {
      const Vec3 corner(Vec3d(v) - centre);
      for (int k = 0; k < 3; ++k) leaf.corners[value++][i] = corner[k];
    }
  }
  leaves.push_back(leaf);
  return static_cast<std::uint32_t>(leaves.size() - 1) | kLeafBit;
}

std::optional<BodyMesh::Point> BodyMesh::first_hit(const Vec3& x, const Vec3d& w) const {
  if (walk) {
    if (auto point = walk->enter(emitters, x, w)) return point;
  }
  static const BodyTrace fastest = body_traces().front();
  return fastest.first_hit(*this, x, w);
}

}  // namespace lemma
