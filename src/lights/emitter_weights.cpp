#include "src/lights/emitter_weights.h"

#include <array>
#include <cmath>

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

/// atan2(y, x) for y > 0, without a branch.
inline float atan2_upper(float y, float x) {
  constexpr float pi = 3.14159265358979f;
  const float ax = std::abs(x);
  const float hi = y > ax ? y : ax, lo = y > ax ? ax : y;
  const float angle = atan_unit(hi > 0 ? lo / hi : 0.0f);
  const float first = y > ax ? 0.5f * pi - angle : angle;
  return x < 0 ? pi - first : first;
}

struct Vertices {
  float ax, ay, az, bx, by, bz, cx, cy, cz;
};

/// luminance x solid angle (the formula of SphericalTriangle::solid_angle), 0 from behind and from within the plane.
inline float weigh(const Vertices& v, float nx, float ny, float nz, float luminance) {
  const float numerator = -(v.ax * nx + v.ay * ny + v.az * nz);
  const float la = std::sqrt(v.ax * v.ax + v.ay * v.ay + v.az * v.az);
  const float lb = std::sqrt(v.bx * v.bx + v.by * v.by + v.bz * v.bz);
  const float lc = std::sqrt(v.cx * v.cx + v.cy * v.cy + v.cz * v.cz);
  const float ab = v.ax * v.bx + v.ay * v.by + v.az * v.bz;
  const float bc = v.bx * v.cx + v.by * v.cy + v.bz * v.cz;
  const float ca = v.cx * v.ax + v.cy * v.ay + v.cz * v.az;
  const float solid_angle = 2 * atan2_upper(numerator, la * lb * lc + ab * lc + bc * la + ca * lb);
  return numerator > 0 ? luminance * solid_angle : 0.0f;
}

}  // namespace

EmitterWeights::EmitterWeights(std::span<const Emitter> emitters) {
  for (const Emitter& e : emitters) {
    const Vec3 n(area_vector(e.shape));
    v0_x_.push_back(e.shape.v0.x), v0_y_.push_back(e.shape.v0.y), v0_z_.push_back(e.shape.v0.z);
    v1_x_.push_back(e.shape.v1.x), v1_y_.push_back(e.shape.v1.y), v1_z_.push_back(e.shape.v1.z);
    v2_x_.push_back(e.shape.v2.x), v2_y_.push_back(e.shape.v2.y), v2_z_.push_back(e.shape.v2.z);
    n_x_.push_back(n.x), n_y_.push_back(n.y), n_z_.push_back(n.z);
    luminance_.push_back(luminance(e.radiance));
  }
}

float EmitterWeights::weight(const Vec3& x, std::size_t i) const {
  return weigh({v0_x_[i] - x.x, v0_y_[i] - x.y, v0_z_[i] - x.z, v1_x_[i] - x.x, v1_y_[i] - x.y,
                v1_z_[i] - x.z, v2_x_[i] - x.x, v2_y_[i] - x.y, v2_z_[i] - x.z},
               n_x_[i], n_y_[i], n_z_[i], luminance_[i]);
}

std::size_t EmitterWeights::weigh_block(const Vec3& x, std::size_t begin,
                                        std::span<float, kBlock> weights) const {
  const std::size_t count = std::min(kBlock, luminance_.size() - begin);
  for (std::size_t j = 0; j < count; ++j) weights[j] = weight(x, begin + j);
  return count;
}

double EmitterWeights::total(const Vec3& x) const {
  double sum = 0;
  std::array<float, kBlock> block;
  for (std::size_t begin = 0; begin < luminance_.size(); begin += kBlock) {
    const std::size_t count = weigh_block(x, begin, block);
    for (std::size_t j = 0; j < count; ++j) sum += block[j];
  }
  return sum;
}

std::size_t EmitterWeights::find(const Vec3& x, double target) const {
  double sum = 0;
  std::size_t last = 0;
  std::array<float, kBlock> block;
  for (std::size_t begin = 0; begin < luminance_.size(); begin += kBlock) {
    const std::size_t count = weigh_block(x, begin, block);
    for (std::size_t j = 0; j < count; ++j) {
      if (block[j] <= 0) continue;
      sum += block[j];
      last = begin + j;
      if (target < sum) return last;
    }
  }
  return last;
}

}  // namespace lemma
