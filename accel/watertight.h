#pragma once

#include <utility>

#include "src/core/hit.h"
#include "src/core/ray.h"
#include "src/core/triangle.h"

namespace lemma {

/// A ray made ready for the watertight triangle test: coordinates permuted so that kz is the direction's
/// largest axis, and the shear that turns the direction into (0, 0, 1). Source: Woop, Benthin, Wald,
/// Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
struct ShearedRay {
  explicit ShearedRay(const Ray& ray) : origin(ray.origin), t_min(ray.t_min), t_max(ray.t_max) {
    const Vec3& d = ray.direction;
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    kz = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    const int after = kz == 2 ? 0 : kz + 1, before = kz == 0 ? 2 : kz - 1;
    const float along = on_axis(d, kz);
    kx = along < 0 ? before : after;
    ky = along < 0 ? after : before;
    sx = on_axis(d, kx) / along;
    sy = on_axis(d, ky) / along;
    sz = 1 / along;
  }

  /// v[k] by selects, for loops over many rays.
  [[nodiscard]] static float on_axis(const Vec3& v, int k) { return k == 0 ? v.x : (k == 1 ? v.y : v.z); }

  Vec3 origin;
  float t_min, t_max;
  float sx, sy, sz;
  int kx, ky, kz;
};

namespace watertight {

/// A vertex in the ray's sheared coordinates: it depends on ray and vertex alone, so triangles that share a
/// vertex see the same bits.
struct Vertex {
  float x, y, z;
};

inline Vertex shear(const ShearedRay& ray, const Vec3& v) {
  const Vec3 a = v - ray.origin;
  const float z = ShearedRay::on_axis(a, ray.kz);
  return {ShearedRay::on_axis(a, ray.kx) - ray.sx * z, ShearedRay::on_axis(a, ray.ky) - ray.sy * z, z};
}

/// b.x c.y - b.y c.x. The products of two floats are exact in double and one rounding follows, so the sign is
/// exact, 0 only if exactly 0, and reversing the edge negates it: neighbours never both miss.
inline double edge(const Vertex& b, const Vertex& c) {
  return static_cast<double>(b.x) * c.y - static_cast<double>(b.y) * c.x;
}

/// Twice the sheared area that each vertex weighs with, and their sum.
struct Weights {
  double u, v, w, sum;
};

inline Weights weights(const Vertex& a, const Vertex& b, const Vertex& c) {
  const double u = edge(c, b), v = edge(a, c), w = edge(b, a);
  return {u, v, w, u + v + w};
}

/// Whether no edge has the ray on its outer side.
inline bool passes_through(const Weights& e) {
  return !(((e.u < 0) | (e.v < 0) | (e.w < 0)) & ((e.u > 0) | (e.v > 0) | (e.w > 0)));
}

inline float distance(const ShearedRay& ray, const Weights& e, const Vertex& a, const Vertex& b,
                      const Vertex& c) {
  return static_cast<float>(ray.sz * (e.u * a.z + e.v * b.z + e.w * c.z) / e.sum);
}

}  // namespace watertight

/// The watertight test of one triangle, both sides, from its sheared vertices. On a hit with t in (ray.t_min,
/// t_max] that is nearer than `best`, or as near with a lower index, replaces `best` and says true. The shear
/// rounds each vertex once, the same for all its triangles: a mesh may be moved by a rounding error, but
/// never torn. The edge functions' signs are exact (edge), so a ray through a closed mesh hits it, also
/// through edges and vertices. t errs by at most kPlaneError (src/core/error_bound.h) units of u M / cos.
inline bool intersect(const ShearedRay& ray, const watertight::Vertex& a, const watertight::Vertex& b,
                      const watertight::Vertex& c, std::uint32_t index, Hit& best) {
  using namespace watertight;
  const Weights e = weights(a, b, c);
  if (!passes_through(e)) return false;
  if (e.sum == 0) return false;
  const float t = distance(ray, e, a, b, c);
  if (!(t > ray.t_min && (t < best.t || (t == best.t && index < best.triangle)))) return false;
  best = {t, index, static_cast<float>(e.v / e.sum), static_cast<float>(e.w / e.sum)};
  return true;
}

/// The same from the triangle itself.
inline bool intersect(const ShearedRay& ray, const Triangle& triangle, std::uint32_t index, Hit& best) {
  using watertight::shear;
  return intersect(ray, shear(ray, triangle.v0), shear(ray, triangle.v1), shear(ray, triangle.v2), index,
                   best);
}

/// The hit on a triangle that another test has found: t and barycentric coordinates as intersect() computes
/// them, moved onto the triangle where the ray passes it by a rounding error. Without branches, for loops
/// over many rays.
inline Hit hit_on(const ShearedRay& ray, const Triangle& triangle, std::uint32_t index) {
  using namespace watertight;
  const Vertex a = shear(ray, triangle.v0), b = shear(ray, triangle.v1), c = shear(ray, triangle.v2);
  const Weights e = weights(a, b, c);
  const bool edge_on = e.sum == 0;  // any of its points will do: v0
  const auto share = [&](double weight, float up_to) {
    const auto exact = static_cast<float>(weight / e.sum);
    const float inside = exact < 0 ? 0 : (exact > up_to ? up_to : exact);
    return edge_on ? 0 : inside;
  };
  const float b1 = share(e.v, 1), b2 = share(e.w, 1 - b1);
  const float on_plane = distance(ray, e, a, b, c);
  const float on_triangle = ray.sz * ((1 - b1 - b2) * a.z + b1 * b.z + b2 * c.z);
  return {edge_on ? ray.sz * a.z : (passes_through(e) ? on_plane : on_triangle), index, b1, b2};
}

/// The `best` before any triangle was tested: hits count below t_max, and t == t_max loses to no index.
inline Hit no_hit(const ShearedRay& ray) {
  return {ray.t_max, 0, 0, 0};
}

}  // namespace lemma
