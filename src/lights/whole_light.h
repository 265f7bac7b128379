#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/lights/emitter.h"

namespace lemma {

/// Emitters that together form a body so round that sampling its bounding sphere's cone is nearly sampling
/// the body: the tessellated spheres that many scenes have as lights.
struct WholeLight {
  Vec3d centre;
  double radius = 0;  // of a sphere about the centre that holds all vertices
  std::vector<std::uint32_t> emitters;
  // Radii of two balls about the centre of whose rays much is known (WholeCore): one in the body, and one in
  // which nothing else lies; 0 if there are none.
  double core = 0, shell = 0;
};

/// Finds those sets of emitters of one light, joined by common vertices, that are
///   closed:      each edge belongs to two triangles, once in each direction;
///   star-shaped: all face away from the centre of their bounding box, so that no two overlap;
///   round:       from any direction the silhouette fills at least half of the bounding sphere's.
/// @param triangles  of the scene, in which Emitter::triangle names the emitters; empty: there is nothing
/// else
[[nodiscard]] std::vector<WholeLight> find_whole_lights(std::span<const Emitter> emitters,
                                                        std::span<const Triangle> triangles);

}  // namespace lemma
