#include "src/shading/dielectric.h"

#include <algorithm>
#include <cmath>

namespace lemma {
namespace {

/// Cosine of the refracted direction, by Snell's law; 0 beyond the critical angle.
float refracted_cosine(float cos_i, float eta) {
  const float sin2 = std::max(0.0f, 1 - cos_i * cos_i) / (eta * eta);
  return sin2 < 1 ? std::sqrt(1 - sin2) : 0.0f;
}

}  // namespace

float fresnel(float cos_i, float eta) {
  const float cos_t = refracted_cosine(cos_i, eta);
  if (cos_t == 0) return 1;
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

DielectricSample sample_dielectric(const Dielectric& boundary, const Vec3& wo, float choice) {
  const float cos_i = std::min(std::abs(wo.z), 1.0f);
  const float eta = wo.z > 0 ? boundary.ior : 1 / boundary.ior;
  if (choice < fresnel(cos_i, eta)) return {{-wo.x, -wo.y, wo.z}, {1, 1, 1}, false};
  const float cos_t = refracted_cosine(cos_i, eta);
  const Vec3 wi(-wo.x / eta, -wo.y / eta, std::copysign(cos_t, -wo.z));
  return {normalize(wi), boundary.transmittance, true};
}

}  // namespace lemma
