#pragma once

#include <optional>

#include "src/core/error_bound.h"
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

/// One that means nothing unless it exists; without branches.
struct PossibleConnection {
  bool exists;
  Connection connection;
};
[[gnu::always_inline, nodiscard]] inline PossibleConnection possible_connection(const Triangle& emitter,
                                                                                const Vec3& x,
                                                                                const Vec3d& y) {
  const Vec3d to_light = y - Vec3d(x);
  const double distance2 = dot(to_light, to_light);
  const Vec3d normal = area_vector(emitter);
  const double facing = -dot(normal, to_light);
  const double cos_light = facing / std::sqrt(dot(normal, normal) * distance2);
  const bool exists = (side_of(emitter, x) > 0) & (cos_light > 0);
  return {exists, {to_light, distance2, std::min(cos_light, 1.0), facing}};
}

[[nodiscard]] inline std::optional<Connection> connect(const Emitter& emitter, const Vec3& x,
                                                       const Vec3d& y) {
  const auto [exists, connection] = possible_connection(emitter.shape, x, y);
  return exists ? std::optional(connection) : std::nullopt;
}

namespace detail {

/// The largest coordinate difference between x and a vertex.
[[gnu::always_inline, nodiscard]] inline float largest_difference(const Triangle& t, const Vec3& x) {
  const auto along = [](float a, float b, float c, float from) {
    return std::max(std::max(std::max(a, b), c) - from, from - std::min(std::min(a, b), c));
  };
  const float in_x = along(t.v0.x, t.v1.x, t.v2.x, x.x), in_y = along(t.v0.y, t.v1.y, t.v2.y, x.y);
  return std::max(std::max(in_x, in_y), along(t.v0.z, t.v1.z, t.v2.z, x.z));
}

}  // namespace detail

/// How far along a connection what blocks it counts, as a part of it: short of the emitter by the bound of
/// what a hit on it, or on a surface in its plane, can err by (kPlaneError); so a light is not shadowed by
/// itself, by its own neighbours in the mesh or by a ceiling that it lies in, and what stands in front of it
/// by more than that still shadows it. The error of a hit's distance is sliver_ratio u M / cos_light; over
/// the distance itself this is longest_edge^2 u M / facing, where neither length nor root is left.
[[gnu::always_inline, nodiscard]] inline float visible_until(const Triangle& emitter, const Vec3& x,
                                                             const Connection& c) {
  // Over kPlaneError: the occluder in the light's plane may be larger than the light and has its own error.
  constexpr double shadow_margin = 4;
  // A light seen so edge-on that its distance is uncertain by more is treated as uncertain by this.
  constexpr double largest_margin = 1e-2;
  constexpr double unit = shadow_margin * kPlaneError * kRoundoff;
  const double error = unit * longest_edge2(emitter) * detail::largest_difference(emitter, x) / c.facing;
  return static_cast<float>(1 - std::min(error, largest_margin));
}

/// The sample for a connection to emitters[index].
[[nodiscard]] LightSample make_light_sample(std::span<const Emitter> emitters, std::size_t index,
                                            const Vec3& x, const Connection& connection, PdfSolidAngle pdf);

}  // namespace lemma
