#include "src/oracle/exact.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <limits>

namespace lemma {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// All that is decided here are signs of sums of products of three differences of floats. In double each
/// product passes at most 3 rounded differences, 2 multiplications and 3 sums, so the result errs by at most
/// 8 roundings of its permanent, the same sum of absolute values.
/// Source: Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997.
constexpr double kFilter = 8 * 0x1.01p-53;  // the last digits cover products of roundings

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> vector(const Vec3& from, const Vec3& to) {
  return {Number(Number(to.x) - Number(from.x)), Number(Number(to.y) - Number(from.y)),
          Number(Number(to.z) - Number(from.z))};
}

/// a . (b x c).
template <class Number>
Number triple(const Vector<Number>& a, const Vector<Number>& b, const Vector<Number>& c) {
  Number sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    sum += a[k] * (b[i] * c[j] - b[j] * c[i]);
  }
  return sum;
}

/// A value in double and how far from it the truth can be.
struct Bounded {
  double value, error;
};

Bounded bounded_triple(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c) {
  double permanent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    permanent += std::abs(a[k]) * (std::abs(b[i] * c[j]) + std::abs(b[j] * c[i]));
  }
  return {triple(a, b, c), kFilter * permanent};
}

/// The sign of d . ((a - o) x (b - a)): on which side of the edge from a to b the ray's line passes.
int edge_sign(const Ray& ray, const Vec3& a, const Vec3& b) {
  const Vec3 zero(0);
  const Bounded e = bounded_triple(vector<double>(zero, ray.direction), vector<double>(ray.origin, a),
                                   vector<double>(a, b));
  if (std::abs(e.value) > e.error) return e.value > 0 ? 1 : -1;
  return triple(vector<Rational>(zero, ray.direction), vector<Rational>(ray.origin, a),
                vector<Rational>(a, b))
      .sign();
}

/// Whether the ray's line meets the closed triangle, and in one point.
bool meets(const Ray& ray, const Triangle& t) {
  bool left = false, right = false;
  for (const int sign :
       {edge_sign(ray, t.v0, t.v1), edge_sign(ray, t.v1, t.v2), edge_sign(ray, t.v2, t.v0)}) {
    left |= sign > 0;
    right |= sign < 0;
  }
  return left != right;
}

/// t at which the ray meets the plane of a triangle: (v0 - o) . n / (d . n), in double, and as a rational for
/// the questions that double leaves open.
class PlaneDistance {
 public:
  /// @param triangle  not parallel to the ray
  PlaneDistance(const Ray& ray, const Triangle& triangle) : ray_(&ray), triangle_(&triangle) {
    const Vector<double> e1 = vector<double>(triangle.v0, triangle.v1),
                         e2 = vector<double>(triangle.v0, triangle.v2);
    const Bounded up = bounded_triple(vector<double>(ray.origin, triangle.v0), e1, e2);
    const Bounded down = bounded_triple(vector<double>(Vec3(0), ray.direction), e1, e2);
    if (std::abs(down.value) > 2 * down.error) {
      // |a/b - A/B| <= (|A - a| + |a/b| |B - b|) / |B|, with |B| > |b| / 2, and the division's own rounding.
      const double t = up.value / down.value;
      t_ = {t, 2 * (up.error + std::abs(t) * down.error) / std::abs(down.value) + 0x1p-53 * std::abs(t)};
    } else {
      t_ = {static_cast<double>(exact()), std::numeric_limits<double>::infinity()};
    }
  }

  [[nodiscard]] double value() const { return t_.value; }

  /// The sign of this minus a float.
  [[nodiscard]] int compare(float other) const {
    if (std::isinf(other)) return other > 0 ? -1 : 1;
    return compare({other, 0}, [&] { return Rational(other); });
  }

  [[nodiscard]] int compare(const PlaneDistance& other) const {
    return compare(other.t_, [&] { return other.exact(); });
  }

 private:
  template <class Exact>
  [[nodiscard]] int compare(const Bounded& other, const Exact& exact_other) const {
    const double gap = t_.value - other.value;
    if (std::abs(gap) > t_.error + other.error + 0x1p-53 * std::abs(gap)) return gap > 0 ? 1 : -1;
    return Rational(exact() - exact_other()).sign();
  }

  [[nodiscard]] Rational exact() const {
    const auto e1 = vector<Rational>(triangle_->v0, triangle_->v1),
               e2 = vector<Rational>(triangle_->v0, triangle_->v2);
    return triple(vector<Rational>(ray_->origin, triangle_->v0), e1, e2) /
           triple(vector<Rational>(Vec3(0), ray_->direction), e1, e2);
  }

  const Ray* ray_;
  const Triangle* triangle_;
  Bounded t_{};
};

}  // namespace

std::optional<ExactHit> exact_hit(const Ray& ray, std::span<const Triangle> triangles,
                                  std::span<const std::uint32_t> candidates) {
  std::optional<PlaneDistance> nearest;
  std::uint32_t hit = 0;
  for (const std::uint32_t i : candidates) {
    if (!meets(ray, triangles[i])) continue;
    const PlaneDistance t(ray, triangles[i]);
    if (t.compare(ray.t_min) <= 0 || t.compare(ray.t_max) >= 0) continue;
    const int order = nearest ? t.compare(*nearest) : -1;
    if (order > 0 || (order == 0 && i > hit)) continue;
    nearest = t;
    hit = i;
  }
  if (!nearest) return std::nullopt;
  return ExactHit{hit, nearest->value()};
}

}  // namespace lemma
