#include "src/lights/connection.h"

#include "src/core/error_bound.h"

namespace lemma {
namespace {

// Margin over kPlaneError: the occluder in the light's plane may be larger than the light and has its own
// error.
constexpr double kShadowMargin = 4;
// A light seen so edge-on that its distance is uncertain by more than this is treated as uncertain by this.
constexpr double kLargestMargin = 1e-2;

/// The largest coordinate difference between x and a vertex.
float largest_difference(const Triangle& t, const Vec3& x) {
  float m = 0;
  for (int k = 0; k < 3; ++k) {
    const float lowest = std::min(std::min(t.v0[k], t.v1[k]), t.v2[k]);
    const float highest = std::max(std::max(t.v0[k], t.v1[k]), t.v2[k]);
    m = std::max(m, std::max(highest - x[k], x[k] - lowest));
  }
  return m;
}

/// The error of a hit's distance is sliver_ratio u M / cos_light; over the distance itself this is
/// longest_edge^2 u M / facing, where neither length nor root is left.
float visible_until(const Emitter& emitter, const Vec3& x, const Connection& c) {
  const Triangle& t = emitter.shape;
  constexpr double unit = kShadowMargin * kPlaneError * kRoundoff;
  const double error = unit * longest_edge2(t) * largest_difference(t, x) / c.facing;
  return static_cast<float>(1 - std::min(error, kLargestMargin));
}

}  // namespace

std::optional<Connection> connect(const Emitter& emitter, const Vec3& x, const Vec3d& y) {
  if (!emits_towards(emitter, x)) return std::nullopt;
  const Vec3d to_light = y - Vec3d(x);
  const double distance2 = dot(to_light, to_light);
  const Vec3d normal = area_vector(emitter.shape);
  const double facing = -dot(normal, to_light);
  const double cos_light = facing / std::sqrt(dot(normal, normal) * distance2);
  if (!(cos_light > 0)) return std::nullopt;
  return Connection{to_light, distance2, std::min(cos_light, 1.0), facing};
}

LightSample make_light_sample(std::span<const Emitter> emitters, std::size_t index, const Vec3& x,
                              const Connection& connection, PdfSolidAngle pdf) {
  return {.wi = Vec3(normalize(connection.to_light)),
          .pdf = pdf,
          .radiance = emitters[index].radiance,
          .to_light = Vec3(connection.to_light),
          .visible_until = visible_until(emitters[index], x, connection),
          .emitter = static_cast<std::uint32_t>(index)};
}

}  // namespace lemma
