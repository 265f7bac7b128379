#include "src/lights/connection.h"

namespace lemma {

LightSample make_light_sample(std::span<const Emitter> emitters, std::size_t index, const Vec3& x,
                              const Connection& connection, PdfSolidAngle pdf) {
  return {.wi = Vec3(normalize(connection.to_light)),
          .pdf = pdf,
          .radiance = emitters[index].radiance,
          .to_light = Vec3(connection.to_light),
          .visible_until = visible_until(emitters[index].shape, x, connection),
          .emitter = static_cast<std::uint32_t>(index)};
}

}  // namespace lemma
