#include "src/lights/connection.h"

#include "src/core/error_bound.h"

namespace lemma {
namespace {

// Margin over kPlaneError: the occluder in the light's plane may be larger than the light and has its own
// error.
constexpr double kShadowMargin = 4;
// A light seen so edge-on that its distance is uncertain by more than this is treated as uncertain by this.
constexpr double kLargestMargin = 1e-2;

float visible_until(const Emitter& emitter, const Vec3& x, const Connection& c) {
  const Triangle& t = emitter.shape;
  const double m = std::max({max_norm(t.v0 - x), max_norm(t.v1 - x), max_norm(t.v2 - x)});
  const double error = kShadowMargin * kPlaneError * kRoundoff * sliver_ratio(t) * m / c.cos_light;
  return static_cast<float>(1 - std::min(error / std::sqrt(c.distance2), kLargestMargin));
}

}  // namespace

std::optional<Connection> connect(const Emitter& emitter, const Vec3& x, const Vec3d& y) {
  if (!emits_towards(emitter, x)) return std::nullopt;
  const Vec3d to_light = y - Vec3d(x);
  const double distance2 = dot(to_light, to_light);
  const Vec3d normal = area_vector(emitter.shape);
  const double cos_light = -dot(normal, to_light) / std::sqrt(dot(normal, normal) * distance2);
  if (!(cos_light > 0)) return std::nullopt;
  return Connection{to_light, distance2, std::min(cos_light, 1.0)};
}

LightSample make_light_sample(std::span<const Emitter> emitters, std::size_t index, const Vec3& x,
                              const Connection& connection, PdfSolidAngle pdf) {
  return {.to_light = Vec3(connection.to_light),
          .wi = Vec3(normalize(connection.to_light)),
          .pdf = pdf,
          .radiance = emitters[index].radiance,
          .emitter = static_cast<std::uint32_t>(index),
          .visible_until = visible_until(emitters[index], x, connection)};
}

}  // namespace lemma
