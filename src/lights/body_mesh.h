#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/lights/convex_walk.h"
#include "src/lights/emitter.h"
#include "src/lights/whole_light.h"

namespace lemma {

/// The triangles of a whole light as a bounding volume hierarchy of 16 children a node and 16 triangles a
/// leaf, for rays from outside. Coordinates are relative to the light's centre, in float32: their errors are
/// roundings of the light's radius, however far away the light is. They only rule triangles out; what is left
/// is decided in double.
struct BodyMesh {
  static constexpr std::size_t kWidth = 16;
  using Values = std::array<float, kWidth>;

  struct Inner {
    std::array<Values, 3> lo, hi;  // boxes of the children, by axis; of no extent where there is none
    std::array<std::uint32_t, kWidth> child{};  // index of an inner node, or with kLeafBit of a leaf
  };
  static constexpr std::uint32_t kLeafBit = 0x80000000u;

  struct Leaf {
    std::array<Values, 9> corners{};  // v0.x, v0.y, v0.z, v1.x ...; places left over repeat the last triangle
    std::array<std::uint32_t, kWidth> emitter{};
  };

  BodyMesh(std::span<const Emitter> all_emitters, const WholeLight& light);

  using Point = BodyPoint;

  /// The first emitter of the light that a ray meets.
  /// @param x  outside of the light's sphere
  /// @param w  unit
  [[nodiscard]] std::optional<Point> first_hit(const Vec3& x, const Vec3d& w) const;

  std::span<const Emitter> emitters;
  std::optional<ConvexWalk> walk;  // of a convex body; finds most points without the hierarchy
  Vec3d centre;
  double radius;
  std::vector<Inner> inners;
  std::vector<Leaf> leaves;
  std::uint32_t root = 0;  // as in Inner::child

 private:
  std::uint32_t build(std::span<std::uint32_t> members);
  std::uint32_t add_leaf(std::span<const std::uint32_t> members);
};

}  // namespace lemma
