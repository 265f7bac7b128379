#include "src/lights/light_tree.h"

#include <algorithm>
#include <limits>

#include "src/lights/light_split.h"

namespace lemma {
namespace {

constexpr double kBelowOne = 1 - 0x1p-53;

}  // namespace

class LightTree::Builder {
 public:
  explicit Builder(LightTree& tree) : tree_(tree) {}

  void build() {
    std::vector<bool> alone(tree_.emitters_.size(), true);
    std::vector<LightItem> items;
    for (std::uint32_t w = 0; w < tree_.wholes_.size(); ++w) {
      const auto& emitters = tree_.wholes_[w].emitters;
      for (const std::uint32_t e : emitters) alone[e] = false;
      LightBounds bounds = bounds_of(items_of(emitters));
      bounds.power /= kSurfaceToSilhouette;
      items.push_back({bounds, LightItem::Kind::whole, w});
    }
    tree_.quads_ = find_quad_lights(tree_.emitters_, alone);
    for (std::uint32_t q = 0; q < tree_.quads_.size(); ++q) {
      const auto& emitters = tree_.quads_[q].emitters();
      for (const std::uint32_t e : emitters) alone[e] = false;
      items.push_back({bounds_of(items_of(emitters)), LightItem::Kind::quad, q});
    }
    for (std::uint32_t e = 0; e < tree_.emitters_.size(); ++e) {
      if (alone[e]) items.push_back({LightBounds(tree_.emitters_[e]), LightItem::Kind::emitter, e});
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
    for (const std::uint32_t e : emitters)
      items.push_back({LightBounds(tree_.emitters_[e]), LightItem::Kind::emitter, e});
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
    add_block(node);
  }

  /// Of the whole lights among a node's children, if any is one.
  void add_block(std::uint32_t node) {
    WholeBlock block;
    for (std::uint32_t i = 0; i < tree_.nodes_[node].children; ++i) {
      const Node& child = tree_.nodes_[tree_.nodes_[node].first_child + i];
      if (child.whole == kNone) continue;
      const WholeLight& light = tree_.wholes_[child.whole];
      block.set(i, light, luminance(tree_.emitters_[light.emitters.front()].radiance));
      tree_.nodes_[node].block = static_cast<std::uint32_t>(tree_.blocks_.size());
    }
    if (tree_.nodes_[node].block != kNone) tree_.blocks_.push_back(block);
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
    switch (item.kind) {
      case LightItem::Kind::emitter:
        tree_.nodes_[node].emitter = item.index;
        tree_.places_[item.index].leaf = node;
        return;
      case LightItem::Kind::whole:
        tree_.nodes_[node].whole = item.index;
        build_group(node, tree_.wholes_[item.index].emitters);
        for (const std::uint32_t e : tree_.wholes_[item.index].emitters) {
          tree_.places_[e].whole = &tree_.wholes_[item.index];
        }
        return;
      case LightItem::Kind::quad:
        tree_.nodes_[node].quad = item.index;
        build_group(node, tree_.quads_[item.index].emitters());
        return;
    }
  }

  void build_group(std::uint32_t node, std::span<const std::uint32_t> emitters) {
    for (const std::uint32_t e : emitters) tree_.places_[e].group = node;
    std::vector<LightItem> parts = items_of(emitters);
    build(node, parts);
  }

  LightTree& tree_;
};

LightTree::LightTree(std::span<const Emitter> emitters, std::span<const Triangle> triangles)
    : emitters_(emitters),
      views_(emitters.begin(), emitters.end()),
      wholes_(find_whole_lights(emitters, triangles)),
      weigh_wholes_(all_weigh_wholes().front().function) {
  Builder(*this).build();
}

/// Luminance x solid angle x cosine at the surface x what it reflects: of a light nearly exactly but for the
/// last factor, of other nodes an estimate. 0 only if no emitter of the node can contribute.
[[gnu::noinline]] double LightTree::importance(const Node& node, const LightQuery& at) const {
  const Reflection& reflection = at.reflection;
  const double irradiance = irradiance_from(node, at);
  if (reflection.peak == 0) return irradiance * reflection.diffuse;
  return irradiance * node.importance.reflected(at.x, reflection);
}

/// Of a node that is no whole light as seen from there.
double LightTree::irradiance_from(const Node& node, const LightQuery& at) const {
  if (node.quad != kNone && is_light(node, at.x)) return quads_[node.quad].view().far_importance(at.x, at.n);
  if (node.children != 0) return node.importance(at.x, at.n);
  const EmitterView& view = views_[node.emitter];
  return view.is_far(at.x) ? view.far_importance(at.x, at.n)
                           : near_importance(emitters_[node.emitter], at.x, at.n);
}

inline LightTree::Weights LightTree::weigh_children(const Node& node, const LightQuery& at) const {
  WholeBlock::Values of_whole;  // negative: not weighed as one
  if (node.block != kNone) {
    weigh_wholes_(blocks_[node.block], node.children, at, of_whole);
  } else {
    of_whole.fill(-1);
  }
  Weights weights;
  double sum = 0;
  for (std::uint32_t i = 0; i < node.children; ++i) {
    const bool weighed = of_whole[i] >= 0;
    const double weight = weighed ? double{of_whole[i]} : importance(nodes_[node.first_child + i], at);
    weights.of_child[i] = weight;
    sum += weight;
  }
  weights.sum = sum;
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
    while (child < node.children && target >= weights.of_child[child]) target -= weights.of_child[child++];
    if (child == node.children) {  // rounding led past all
      do --child;
      while (weights.of_child[child] == 0);
    }
    u = std::clamp(target / weights.of_child[child], 0.0, kBelowOne);
    pmf *= weights.of_child[child] / weights.sum;
    index = node.first_child + child;
  }
  Choice light = choice(index, pmf);
  light.u = u;
  return light;
}

LightTree::Choice LightTree::choice_of(const LightQuery& at, std::uint32_t emitter) const {
  const auto& [leaf, group, whole] = places_[emitter];
  const std::uint32_t light = group != kNone && is_light(nodes_[group], at.x) ? group : leaf;
  double pmf = 1;
  for (std::uint32_t node = light; nodes_[node].parent != kNone; node = nodes_[node].parent) {
    const Node& parent = nodes_[nodes_[node].parent];
    const Weights weights = weigh_children(parent, at);
    const double own = weights.of_child[node - parent.first_child];
    if (own == 0) return choice(light, 0);
    pmf *= own / weights.sum;
  }
  return choice(light, pmf);
}

std::optional<LightRow> LightTree::row() const {
  const auto is_group = [](const Node& node) { return node.whole != kNone || node.quad != kNone; };
  LightRow row;
  row.is_single = is_group(nodes_.front());
  row.emitters = emitters_;
  const Node& root = nodes_.front();
  const std::uint32_t first = row.is_single ? 0 : root.first_child, count = row.is_single ? 1 : root.children;
  if (count == 0) return std::nullopt;
  row.light_of.resize(emitters_.size());
  for (std::uint32_t k = 0; k < count; ++k) {
    const Node& node = nodes_[first + k];
    if (!is_group(node)) return std::nullopt;
    LightRow::Light light(node.importance);
    if (node.whole != kNone) {
      light.whole = &wholes_[node.whole];
      light.radiance = emitters_[light.whole->emitters.front()].radiance;
      light.outline = outline_of(*light.whole, luminance(light.radiance));
      for (const std::uint32_t e : light.whole->emitters) row.light_of[e] = k;
    } else {
      light.quad = &quads_[node.quad];
      for (const std::uint32_t e : light.quad->emitters()) row.light_of[e] = k;
    }
    row.lights.push_back(light);
  }
  return row;
}

}  // namespace lemma
