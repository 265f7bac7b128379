#pragma once

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>

namespace lemma {

// The vector types are Imath's; these names and free functions are how formulas read here.
using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Vec3d = Imath::V3d;

template <class T>
[[nodiscard]] inline T dot(const Imath::Vec3<T>& a, const Imath::Vec3<T>& b) {
  return a.dot(b);
}

template <class T>
[[nodiscard]] inline Imath::Vec3<T> cross(const Imath::Vec3<T>& a, const Imath::Vec3<T>& b) {
  return a.cross(b);
}

template <class T>
[[nodiscard]] inline T length(const Imath::Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}

/// a / |a|; components are not finite when |a| is 0 or overflows.
template <class T>
[[nodiscard]] inline Imath::Vec3<T> normalize(const Imath::Vec3<T>& a) {
  return a * (T(1) / length(a));
}

/// The largest |component|: the infinity norm.
template <class T>
[[nodiscard]] inline T max_norm(const Imath::Vec3<T>& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// Without branches, for loops over lanes.
[[nodiscard]] inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) & std::isfinite(a.y) & std::isfinite(a.z);
}

}  // namespace lemma
