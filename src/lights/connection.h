#pragma once

#include <optional>

#include "src/lights/light_sampler.h"

namespace lemma {

/// What the segment from x to the point y of an emitter needs, in double. Exists only if the emitter emits
/// along it.
struct Connection {
  Vec3d to_light;    // y - x
  double distance2;  // |y - x|^2 > 0
  double cos_light;  // cosine at the emitter, in (0, 1]
  double facing;     // the same times |area_vector| |y - x|
};

[[nodiscard]] std::optional<Connection> connect(const Emitter& emitter, const Vec3& x, const Vec3d& y);

/// The sample for a connection to emitters[index]. visible_until stops short of the emitter by the bound of
/// what a hit on it, or on a surface in its plane, can err by (kPlaneError); so a light is not shadowed by
/// itself, by its own neighbours in the mesh or by a ceiling that it lies in, and what stands in front of it
/// by more than that still shadows it.
[[nodiscard]] LightSample make_light_sample(std::span<const Emitter> emitters, std::size_t index,
                                            const Vec3& x, const Connection& connection, PdfSolidAngle pdf);

}  // namespace lemma
