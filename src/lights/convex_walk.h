#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/lights/emitter.h"
#include "src/lights/whole_light.h"

namespace lemma {

/// A point on the surface of a whole light.
struct BodyPoint {
  std::uint32_t emitter;
  Vec3d y;
};

/// The way into a convex body: a ray enters it through the one triangle that it crosses from its front, and
/// wherever one starts, the triangle lies beyond the edges that the ray passes on the outer side. Source:
/// Devillers, Pion, Teillaud, Walking in a Triangulation, 2002 (the visibility walk); here the triangulation
/// is that of the silhouette.
class ConvexWalk {
 public:
  /// @return nothing if the body has a dent that is more than the rounding of its vertices
  [[nodiscard]] static std::optional<ConvexWalk> find(std::span<const Emitter> emitters,
                                                      const WholeLight& light);

  /// Where a ray enters; nothing if the walk did not lead there, be it that the ray passes by.
  /// @param x  outside of the light's sphere
  /// @param w  unit
  [[nodiscard]] std::optional<BodyPoint> enter(std::span<const Emitter> emitters, const Vec3& x,
                                               const Vec3d& w) const;

 private:
  ConvexWalk(std::span<const Emitter> emitters, const WholeLight& light);

  struct Face {
    std::uint32_t emitter;
    std::array<std::uint32_t, 3> across;  // the neighbour beyond the edge opposite to each corner
  };
  void join_faces(std::span<const Emitter> emitters);
  [[nodiscard]] bool has_dent(std::span<const Emitter> emitters) const;
  void find_starts(std::span<const Emitter> emitters);
  [[nodiscard]] std::size_t cell_of(const Vec3d& direction) const;

  Vec3d centre_;
  double radius_;
  std::vector<Face> faces_;
  // For directions from the centre, by cells on the sides of a cube: a face there or near.
  std::size_t resolution_;  // cells along an edge of the cube
  std::vector<std::uint32_t> starts_;
};

}  // namespace lemma
