#include "src/oracle/passage.h"

#include <algorithm>

#include "src/core/error_bound.h"

namespace lemma {
namespace {

using Answer = Passage::Answer;

/// t of the nearest and of the farthest vertex along the ray's largest axis. Both backends interpolate t
/// between the vertices' t with weights of one sign, so nothing else can come out; 4 u covers the roundings
/// of v - o, of the division and of the result.
struct Slab {
  double lo, hi;

  [[nodiscard]] double clamp(double t) const { return std::clamp(t, lo, hi); }
};

Slab slab_of(const LongRay& ray, const Triangle& triangle) {
  const auto t = [&](const Vec3& v) {
    return (static_cast<double>(v[ray.kz]) - ray.origin[ray.kz]) / ray.direction[ray.kz];
  };
  const auto [lo, hi] = std::minmax({t(triangle.v0), t(triangle.v1), t(triangle.v2)});
  const double slack = 4 * kRoundoff * std::max(std::abs(lo), std::abs(hi));
  return {lo - slack, hi + slack};
}

/// Signs of the three edge functions, 0 within the band.
/// @param unit  u M |d|
/// @return the sum of the bands' widths
double find_sides(const LongRay& ray, const Triangle& triangle, double unit, Passage& p) {
  const std::array<Vec3d, 3> v{Vec3d(triangle.v0), Vec3d(triangle.v1), Vec3d(triangle.v2)};
  double bands = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &a = v[(i + 1) % 3], &b = v[(i + 2) % 3];
    const double e = dot(ray.direction, cross(a - ray.origin, b - a));
    const double band = kEdgeBand * unit * length(b - a);
    p.side[i] = static_cast<std::int8_t>(e > band ? 1 : e < -band ? -1 : 0);
    bands += band;
  }
  return bands;
}

Answer inside(const std::array<std::int8_t, 3>& side) {
  const auto [least, most] = std::ranges::minmax(side);
  if (least < 0 && most > 0) return Answer::no;
  return least * most > 0 ? Answer::yes : Answer::unsure;
}

Answer in_range(const LongRay& ray, double lo, double hi) {
  if (hi <= ray.t_min || lo >= ray.t_max) return Answer::no;
  return lo > ray.t_min && hi < ray.t_max ? Answer::yes : Answer::unsure;
}

}  // namespace

LongRay::LongRay(const Ray& ray)
    : origin(ray.origin),
      direction(ray.direction),
      length(lemma::length(direction)),
      t_min(ray.t_min),
      t_max(ray.t_max) {
  const Vec3d size(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
  kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  kx = (kz + 1) % 3;
  ky = (kz + 2) % 3;
}

Vec3d LongRay::beside(const Vec3& point) const {
  const Vec3d a = Vec3d(point) - origin;
  const double along = a[kz] / direction[kz];
  return {a[kx] - direction[kx] * along, a[ky] - direction[ky] * along, a[kz]};
}

double reach_of(const LongRay& ray, const Triangle& t) {
  return std::max({max_norm(Vec3d(t.v0) - ray.origin), max_norm(Vec3d(t.v1) - ray.origin),
                   max_norm(Vec3d(t.v2) - ray.origin)});
}

Passage passage(const LongRay& ray, const Triangle& triangle, std::uint32_t index) {
  Passage p{.triangle = index};
  const double unit = kRoundoff * reach_of(ray, triangle);
  const double bands = find_sides(ray, triangle, unit * ray.length, p);
  p.inside = inside(p.side);
  if (p.inside == Answer::no && !p.touches_edge()) return p;

  const Vec3d normal = area_vector(triangle);
  const double facing = dot(normal, ray.direction);
  const Slab slab = slab_of(ray, triangle);
  p.grazing = std::abs(facing) <= bands;
  if (p.grazing) {
    p.lo = slab.lo, p.hi = slab.hi;
    p.t = (p.lo + p.hi) / 2;
    p.tolerance = (p.hi - p.lo) / 2;
    p.in_range = in_range(ray, p.lo, p.hi);
    return p;
  }
  p.t = dot(normal, Vec3d(triangle.v0) - ray.origin) / facing;
  const double error = unit * length(normal) / std::abs(facing);  // u M / (cos |d|)
  p.tolerance = kDistanceBand * sliver_ratio(triangle) * error;
  p.lo = slab.clamp(p.t - p.tolerance);
  p.hi = slab.clamp(p.t + p.tolerance);
  p.in_range = in_range(ray, slab.clamp(p.t - kRangeBand * error), slab.clamp(p.t + kRangeBand * error));
  return p;
}

}  // namespace lemma
