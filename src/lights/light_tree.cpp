#include "src/lights/light_tree.h"

#include <algorithm>
#include <limits>

#include "src/lights/light_split.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/spherical_triangle.h"

namespace lemma {
namespace {

constexpr double kBelowOne = 1 - 0x1p-53;

}  // namespace

class LightTree::Builder {
 public:
  explicit Builder(LightTree& tree) : tree_(tree) {}

  void build() {
    std::vector<bool> in_whole(tree_.emitters_.size(), false);
    std::vector<LightItem> items;
    for (std::uint32_t w = 0; w < tree_.wholes_.size(); ++w) {
      const auto& emitters = tree_.wholes_[w].emitters;
      for (const std::uint32_t e : emitters) in_whole[e] = true;
      LightBounds bounds = bounds_of(items_of(emitters));
      bounds.power /= kSurfaceToSilhouette;
      items.push_back({bounds, w, true});
    }
    for (std::uint32_t e = 0; e < tree_.emitters_.size(); ++e) {
      if (!in_whole[e]) items.push_back({LightBounds(tree_.emitters_[e]), e, false});
    }
    tree_.places_.resize(tree_.emitters_.size());
    tree_.nodes_.emplace_back(bounds_of(items));
    build(0, items);
  }

 private:
  // The surface of a convex body is four times its mean silhouette (Cauchy), which is what others see of it.
  static constexpr double kSurfaceToSilhouette = 4;

  [[nodiscard]] std::vector<LightItem> items_of(std::span<const std::uint32_t> emitters) const {
    std::vector<LightItem> items;
    for (const std::uint32_t e : emitters) items.push_back({LightBounds(tree_.emitters_[e]), e, false});
    return items;
  }

  static LightBounds bounds_of(std::span<const LightItem> items) {
    LightBounds bounds = items.front().bounds;
    for (const LightItem& item : items.subspan(1)) bounds = LightBounds(bounds, item.bounds);
    return bounds;
  }

  /// Fills in a node that has the bounds of the items.
  void build(std::uint32_t node, std::span<LightItem> items) {
    if (items.size() == 1) {
      build_single(node, items.front());
      return;
    }
    const auto parts = split_widely(items);
    const auto first = static_cast<std::uint32_t>(tree_.nodes_.size());
    for (const auto& part : parts) tree_.nodes_.emplace_back(bounds_of(part)).parent = node;
    tree_.nodes_[node].first_child = first;
    tree_.nodes_[node].children = static_cast<std::uint32_t>(parts.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) build(first + i, parts[i]);
  }

  /// Splits items into those of up to kWidth children: again and again the part of most power in two.
  static std::vector<std::span<LightItem>> split_widely(std::span<LightItem> items) {
    std::vector<std::span<LightItem>> parts{items};
    const auto power = [](std::span<LightItem> part) {
      return part.size() == 1 ? -1.0 : bounds_of(part).power;
    };
    while (parts.size() < std::min(kWidth, items.size())) {
      const auto strongest = std::ranges::max_element(parts, {}, power);
      const std::size_t first = split_lights(*strongest);
      const auto second = strongest->subspan(first);
      *strongest = strongest->first(first);
      parts.push_back(second);
    }
    return parts;
  }

  void build_single(std::uint32_t node, const LightItem& item) {
    if (item.whole) {
      tree_.nodes_[node].whole = item.index;
      for (const std::uint32_t e : tree_.wholes_[item.index].emitters) tree_.places_[e].whole = node;
      std::vector<LightItem> parts = items_of(tree_.wholes_[item.index].emitters);
      build(node, parts);
    } else {
      tree_.nodes_[node].emitter = item.index;
      tree_.places_[item.index].leaf = node;
    }
  }

  LightTree& tree_;
};

LightTree::LightTree(std::span<const Emitter> emitters)
    : emitters_(emitters), wholes_(find_whole_lights(emitters)) {
  Builder(*this).build();
}

/// Whether the node is a light by itself as seen from x.
bool LightTree::is_light(const Node& node, const Vec3& x) const {
  if (node.children == 0) return true;
  if (node.whole == kNone) return false;
  const WholeLight& whole = wholes_[node.whole];
  return SphereCone(whole.centre, whole.radius, x).can_be_sampled();
}

/// Luminance x solid angle x cosine at the surface: of a light nearly exactly, of other nodes an estimate. 0
/// only if no emitter of the node can contribute.
double LightTree::importance(const Node& node, const LightQuery& at) const {
  const Vec3d n(at.n);
  if (node.children == 0) {
    const Emitter& emitter = emitters_[node.emitter];
    if (!emits_towards(emitter, at.x)) return 0;
    const SphericalTriangle seen(emitter.shape, at.x);
    if (!(seen.solid_angle() > 0)) return 0;
    return luminance(emitter.radiance) * seen.solid_angle() * seen.mean_cosine(n);
  }
  if (node.whole != kNone) {
    const WholeLight& whole = wholes_[node.whole];
    const SphereCone cone(whole.centre, whole.radius, at.x);
    if (cone.can_be_sampled()) {
      return luminance(emitters_[whole.emitters.front()].radiance) * cone.solid_angle() * cone.mean_cosine(n);
    }
  }
  return node.importance(at.x, at.n);
}

LightTree::Choice LightTree::choice(std::uint32_t index, double pmf, const Vec3& x) const {
  const Node& node = nodes_[index];
  const bool whole = node.whole != kNone && is_light(node, x);
  return {pmf, node.emitter, whole ? &wholes_[node.whole] : nullptr, index};
}

LightTree::Weights LightTree::weigh_children(const Node& node, const LightQuery& at) const {
  Weights weights;
  for (std::uint32_t i = 0; i < node.children; ++i) {
    weights.of_child[i] = importance(nodes_[node.first_child + i], at);
    weights.sum += weights.of_child[i];
  }
  return weights;
}

std::optional<LightTree::Choice> LightTree::choose(const LightQuery& at, double u) const {
  std::uint32_t index = 0;
  double pmf = 1;
  while (!is_light(nodes_[index], at.x)) {
    const Node& node = nodes_[index];
    const Weights weights = weigh_children(node, at);
    if (!(weights.sum > 0)) return std::nullopt;
    double target = u * weights.sum;
    std::uint32_t child = 0;
    for (std::uint32_t i = 0; i < node.children; ++i) {
      if (weights.of_child[i] == 0) continue;
      child = i;  // the last of any weight, should rounding lead past all
      if (target < weights.of_child[i]) break;
      target -= weights.of_child[i];
    }
    u = std::clamp(target / weights.of_child[child], 0.0, kBelowOne);
    pmf *= weights.of_child[child] / weights.sum;
    index = node.first_child + child;
  }
  return choice(index, pmf, at.x);
}

LightTree::Choice LightTree::choice_of(const LightQuery& at, std::uint32_t emitter) const {
  const auto& [leaf, whole] = places_[emitter];
  const std::uint32_t light = whole != kNone && is_light(nodes_[whole], at.x) ? whole : leaf;
  double pmf = 1;
  for (std::uint32_t node = light; nodes_[node].parent != kNone; node = nodes_[node].parent) {
    const Node& parent = nodes_[nodes_[node].parent];
    const Weights weights = weigh_children(parent, at);
    const double own = weights.of_child[node - parent.first_child];
    if (own == 0) return choice(light, 0, at.x);
    pmf *= own / weights.sum;
  }
  return choice(light, pmf, at.x);
}

struct LightTree::Ray {
  Vec3d origin, direction, inverse;
};

struct LightTree::Nearest {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t emitter = kNone;
  Vec3d y;
};

namespace {

/// Where a ray enters a box; infinite if it misses it. The margin is far above the rounding in double and
/// lets no ray slip past the rim of a flat box.
double entry(const Bounds& box, const Vec3d& origin, const Vec3d& inverse) {
  constexpr double margin = 1 + 1e-12;
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double a = (double{box.lo[k]} - origin[k]) * inverse[k];
    const double b = (double{box.hi[k]} - origin[k]) * inverse[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b) * margin);
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

struct Crossing {
  double t;
  Vec3d y;
};

/// Where a ray crosses a triangle, by the signs of the volumes that it spans with the edges.
std::optional<Crossing> cross_triangle(const Triangle& triangle, const Vec3d& origin, const Vec3d& w) {
  const Vec3d a = Vec3d(triangle.v0) - origin, b = Vec3d(triangle.v1) - origin,
              c = Vec3d(triangle.v2) - origin;
  const double at_a = dot(w, cross(b, c)), at_b = dot(w, cross(c, a)), at_c = dot(w, cross(a, b));
  if ((at_a < 0 || at_b < 0 || at_c < 0) && (at_a > 0 || at_b > 0 || at_c > 0)) return std::nullopt;
  const double sum = at_a + at_b + at_c;
  if (sum == 0) return std::nullopt;
  const Vec3d y = (a * at_a + b * at_b + c * at_c) * (1 / sum);
  const double t = dot(y, w);
  if (!(t > 0)) return std::nullopt;
  return Crossing{t, y + origin};
}

}  // namespace

void LightTree::find_nearest(std::uint32_t index, const Ray& ray, Nearest& nearest) const {
  const Node& node = nodes_[index];
  if (node.children == 0) {
    const auto crossing = cross_triangle(emitters_[node.emitter].shape, ray.origin, ray.direction);
    if (crossing && crossing->t < nearest.t) nearest = {crossing->t, node.emitter, crossing->y};
    return;
  }
  for (std::uint32_t child = node.first_child; child < node.first_child + node.children; ++child) {
    if (entry(nodes_[child].box, ray.origin, ray.inverse) < nearest.t) find_nearest(child, ray, nearest);
  }
}

std::optional<LightTree::EmitterPoint> LightTree::first_hit(std::uint32_t node, const Vec3& x,
                                                            const Vec3d& w) const {
  Nearest nearest;
  find_nearest(node, {Vec3d(x), w, Vec3d(1 / w.x, 1 / w.y, 1 / w.z)}, nearest);
  if (nearest.emitter == kNone) return std::nullopt;
  return EmitterPoint{nearest.emitter, nearest.y};
}

}  // namespace lemma
