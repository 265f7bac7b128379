#pragma once

#include <array>
#include <optional>
#include <vector>

#include "src/lights/emitter_view.h"
#include "src/lights/light_bounds.h"
#include "src/lights/light_row.h"
#include "src/lights/light_sampler.h"
#include "src/lights/quad_light.h"
#include "src/lights/sphere_cone.h"
#include "src/lights/weigh_wholes.h"
#include "src/lights/whole_light.h"

namespace lemma {

/// A tree over emitters, from which a light is drawn by going down to one of a node's children with
/// probability ~ its importance as seen from the point. Nodes are wide: with few lights, all are weighed one
/// by one and nothing needs to be estimated. A light is a whole light (whole_light.h) where x can see it as
/// one, or a quad (quad_light.h) where x is far enough, else an emitter. Below the node of a whole light or a
/// quad lies the tree of its own emitters.
class LightTree {
 public:
  /// @param triangles  as of find_whole_lights()
  LightTree(std::span<const Emitter> emitters, std::span<const Triangle> triangles);

  /// A light chosen: one of the three.
  struct Choice {
    double pmf = 0;
    std::uint32_t emitter = 0;
    const WholeLight* whole = nullptr;  // if one of these two is there, `emitter` ...
    const QuadLight* quad = nullptr;    // ... means nothing
    double u = 0;  // of choose(): what the choice leaves of its number, uniform in [0, 1)
  };

  /// Draws a light for u uniform in [0, 1); nothing if no light can reach the surface.
  [[nodiscard]] std::optional<Choice> choose(const LightQuery& at, double u) const;

  /// Whether an emitter that is a light by itself is sampled by area from there.
  [[nodiscard]] bool samples_area(const Vec3& x, std::uint32_t emitter) const {
    return views_[emitter].is_far(x);
  }

  /// The light that an emitter is sampled with from there, and the probability that choose() returns it.
  [[nodiscard]] Choice choice_of(const LightQuery& at, std::uint32_t emitter) const;

  /// The whole light that an emitter is a part of, or null.
  [[nodiscard]] const WholeLight* whole_of(std::uint32_t emitter) const { return places_[emitter].whole; }

  /// The lights in the order in which they are chosen among; nothing if the tree has levels above them or
  /// emitters among them.
  [[nodiscard]] std::optional<LightRow> row() const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  struct Node {
    explicit Node(const LightBounds& bounds) : importance(bounds) {}
    LightImportance importance;
    std::uint32_t parent = kNone;
    std::uint32_t first_child = 0, children = 0;  // children lie together; a leaf has none
    std::uint32_t emitter = kNone;                // of a leaf
    std::uint32_t whole = kNone;                  // index into wholes_, or ...
    std::uint32_t quad = kNone;                   // ... into quads_, if it is one
    std::uint32_t block = kNone;                  // index into blocks_, if a child is a whole light
  };
  /// The nodes of an emitter, and of the whole light or the quad it belongs to if it does.
  struct Place {
    std::uint32_t leaf = kNone, group = kNone;
    const WholeLight* whole = nullptr;
  };
  class Builder;

  static constexpr std::size_t kWidth = WholeBlock::kSize;  // children of a node at most

  /// Importances of a node's children.
  struct Weights {
    std::array<double, kWidth> of_child;
    double sum = 0;
  };
  [[nodiscard]] Weights weigh_children(const Node& node, const LightQuery& at) const;
  /// Whether the node is a light by itself as seen from x.
  [[nodiscard]] bool is_light(const Node& node, const Vec3& x) const {
    if (node.children == 0) return true;
    if (node.quad != kNone) return quads_[node.quad].view().is_far(x);
    if (node.whole == kNone) return false;
    const WholeLight& whole = wholes_[node.whole];
    return SphereCone::can_be_sampled(whole.centre, whole.radius, x);
  }
  [[nodiscard]] double importance(const Node& node, const LightQuery& at) const;
  [[nodiscard]] double irradiance_from(const Node& node, const LightQuery& at) const;
  /// Of a node that is a light as seen from where the choice is made.
  [[nodiscard]] Choice choice(std::uint32_t index, double pmf) const {
    const Node& node = nodes_[index];
    Choice light{.pmf = pmf, .emitter = node.emitter};
    if (node.children == 0) return light;
    if (node.whole != kNone) light.whole = &wholes_[node.whole];
    if (node.quad != kNone) light.quad = &quads_[node.quad];
    return light;
  }

  std::span<const Emitter> emitters_;
  std::vector<EmitterView> views_;  // by emitter
  std::vector<WholeLight> wholes_;
  std::vector<QuadLight> quads_;
  std::vector<Node> nodes_;         // the root first
  std::vector<WholeBlock> blocks_;  // whole lights by the places of a node's children
  decltype(WeighWholes::function) weigh_wholes_;
  std::vector<Place> places_;  // by emitter
};

}  // namespace lemma
