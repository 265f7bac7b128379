#include "src/lights/emitter_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lemma {
namespace {

/// atan(r) for r in [0, 1], relative error below 2e-7 (float32): an odd minimax polynomial, so that 0 stays
/// exact.
inline float atan_unit(float r) {
  const float s = r * r;
  float p = 0.0028662257f;
  p = p * s - 0.0161657367f;
  p = p * s + 0.0429096138f;
  p = p * s - 0.0752896400f;
  p = p * s + 0.1065626393f;
  p = p * s - 0.1420889944f;
  p = p * s + 0.1999355085f;
  p = p * s - 0.3333314528f;
  return r + r * s * p;
}

/// atan2(y, x) for y > 0. Written without branches, as sums with a sign, so that loops over it are
/// vectorised.
inline float atan2_upper(float y, float x) {
  constexpr float pi = 3.14159265358979f;
  const float ax = std::abs(x);
  const float hi = std::max(y, ax), lo = std::min(y, ax);
  const float angle = atan_unit(lo / (hi + std::numeric_limits<float>::min()));
  const float steep = static_cast<float>(y > ax);  // then the angle was measured from the y axis
  const float acute = steep * (0.5f * pi) + (1 - 2 * steep) * angle;
  const float obtuse = static_cast<float>(x < 0);
  return obtuse * pi + (1 - 2 * obtuse) * acute;
}

/// Sum of a block in an order that leaves several additions independent: a single chain of them would take as
/// long as the weights.
template <std::size_t N>
double sum(const std::array<float, N>& values) {
  constexpr std::size_t lanes = 8;
  std::array<float, lanes> partial{};
  for (std::size_t i = 0; i < N; i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) partial[k] += values[i + k];
  }
  double total = 0;
  for (const float p : partial) total += p;
  return total;
}

/// Where the running sum passes `target`; the last positive value if it never does.
template <std::size_t N>
std::size_t find_within(const std::array<float, N>& values, double target) {
  double running = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < N; ++i) {
    if (values[i] <= 0) continue;
    running += values[i];
    last = i;
    if (target < running) break;
  }
  return last;
}

}  // namespace

EmitterWeights::EmitterWeights(std::span<const Emitter> emitters)
    : blocks_((emitters.size() + kBlock - 1) / kBlock) {
  for (std::size_t e = 0; e < emitters.size(); ++e) {
    Block& b = blocks_[e / kBlock];
    const std::size_t i = e % kBlock;
    const Triangle& t = emitters[e].shape;
    const Vec3 n(area_vector(t));
    b.v0_x[i] = t.v0.x, b.v0_y[i] = t.v0.y, b.v0_z[i] = t.v0.z;
    b.v1_x[i] = t.v1.x, b.v1_y[i] = t.v1.y, b.v1_z[i] = t.v1.z;
    b.v2_x[i] = t.v2.x, b.v2_y[i] = t.v2.y, b.v2_z[i] = t.v2.z;
    b.normal_x[i] = n.x, b.normal_y[i] = n.y, b.normal_z[i] = n.z;
    b.luminance[i] = luminance(emitters[e].radiance);
  }
}

/// luminance x solid angle (the formula of SphericalTriangle::solid_angle), 0 from behind and from within the
/// plane.
inline float EmitterWeights::weigh(const Block& b, const Vec3& x, std::size_t i) {
  const float ax = b.v0_x[i] - x.x, ay = b.v0_y[i] - x.y, az = b.v0_z[i] - x.z;
  const float bx = b.v1_x[i] - x.x, by = b.v1_y[i] - x.y, bz = b.v1_z[i] - x.z;
  const float cx = b.v2_x[i] - x.x, cy = b.v2_y[i] - x.y, cz = b.v2_z[i] - x.z;
  const float numerator = -(ax * b.normal_x[i] + ay * b.normal_y[i] + az * b.normal_z[i]);
  const float la = std::sqrt(ax * ax + ay * ay + az * az);
  const float lb = std::sqrt(bx * bx + by * by + bz * bz);
  const float lc = std::sqrt(cx * cx + cy * cy + cz * cz);
  const float ab = ax * bx + ay * by + az * bz;
  const float bc = bx * cx + by * cy + bz * cz;
  const float ca = cx * ax + cy * ay + cz * az;
  const float solid_angle =
      2 * atan2_upper(std::max(numerator, 0.0f), la * lb * lc + ab * lc + bc * la + ca * lb);
  const float front = static_cast<float>(numerator > 0);
  return front * b.luminance[i] * solid_angle;
}

inline std::array<float, EmitterWeights::kBlock> EmitterWeights::weigh_all(const Block& block,
                                                                           const Vec3& x) {
  std::array<float, kBlock> weights;
  for (std::size_t i = 0; i < kBlock; ++i) weights[i] = weigh(block, x, i);
  return weights;
}

float EmitterWeights::weight(const Vec3& x, std::size_t emitter) const {
  return weigh(blocks_[emitter / kBlock], x, emitter % kBlock);
}

double EmitterWeights::total(const Vec3& x) const {
  double total = 0;
  for (const Block& block : blocks_) total += sum(weigh_all(block, x));
  return total;
}

std::size_t EmitterWeights::find(const Vec3& x, double target) const {
  std::size_t found = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const std::array<float, kBlock> weights = weigh_all(blocks_[b], x);
    const double block_sum = sum(weights);
    if (block_sum > 0) {
      found = b * kBlock + find_within(weights, target);
      if (target < block_sum) return found;
    }
    target -= block_sum;
  }
  return found;
}

}  // namespace lemma
