#include "src/lights/projected_triangle.h"

#include <algorithm>

#include "src/lights/tangent.h"

namespace lemma {
namespace {

double determinant(const Vec3d& a, const Vec3d& b) {
  return a.x * b.y - a.y * b.x;
}

double dot_in_plane(const Vec3d& a, const Vec3d& b) {
  return a.x * b.x + a.y * b.y;
}

/// The direction of v in the plane; 0 at the zenith.
Vec3d azimuth(const Vec3d& v) {
  const double size = std::hypot(v.x, v.y);
  return size > 0 ? Vec3d(v.x / size, v.y / size, 0) : Vec3d(0);
}

}  // namespace

/// A = D / 2 atan2(det(d0, d), D (d0 . d + (e . d0)(e . d))) with e = m_xy / m_z and D = 1 / sqrt(1 + e^2),
/// multiplied by m_z^2 so that upright circles (m_z = 0) are no exception. The lengths of d0 and d cancel.
double ProjectedTriangle::Ellipse::area(const Vec3d& from, const Vec3d& to) const {
  const double z2 = m_.z * m_.z;
  return 0.5 * flatness_ *
         std::atan2(z2 * determinant(from, to), flatness_ * (z2 * dot_in_plane(from, to) +
                                                             dot_in_plane(m_, from) * dot_in_plane(m_, to)));
}

double ProjectedTriangle::Ellipse::height2(const Vec3d& d) const {
  if (flatness_ == 0) return 1;
  const double rise = dot_in_plane(m_, d);
  return rise * rise / (m_.z * m_.z + rise * rise);
}

double ProjectedTriangle::Sector::area_up_to(const Vec3d& d) const {
  return outer.area(from, d) - inner.area(from, d);
}

/// By Newton's method within a bracket that shrinks. Directions run along the chord: from + s (to - from).
Vec3d ProjectedTriangle::Sector::direction_at(double part) const {
  constexpr int most_steps = 50;    // as many as bisection alone would need
  constexpr double precise = 1e-9;  // then the step just made squares the error
  const double turn = determinant(from, to);
  double low = 0, high = 1, s = part / area;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3d along = from + (to - from) * s, d = normalize(along);
    const double excess = area_up_to(along) - part;
    (excess > 0 ? high : low) = s;
    const double slope = 0.5 * turn * (inner.height2(d) - outer.height2(d)) / dot(along, along);
    const double next = s - excess / slope;
    if (std::abs(next - s) < precise) {
      s = std::clamp(next, 0.0, 1.0);
      break;
    }
    s = next > low && next < high ? next : 0.5 * (low + high);
  }
  return normalize(from + (to - from) * s);
}

/// The triangle in the frame (s, t, n), cut off below the horizon; counter-clockwise seen from above.
class ProjectedTriangle::Polygon {
 public:
  Polygon(const std::array<Vec3d, 3>& v) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d &a = v[i], &b = v[(i + 1) % 3];
      // Differences of the vertices keep digits that a x b would lose.
      const Vec3d plane = cross(a, b - a), horizon(0, 0, 1);
      if (a.z > 0 || (a.z == 0 && b.z >= 0)) add(a, plane);
      if (a.z == 0 && b.z < 0) add(a, horizon);
      if (a.z > 0 && b.z < 0) add(on_horizon(a, b), horizon);
      if (a.z < 0 && b.z > 0) add(on_horizon(a, b), plane);
    }
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Vec3d& direction(std::size_t i) const { return direction_[i % size_]; }
  [[nodiscard]] const Ellipse& edge(std::size_t i) const { return edge_[i % size_]; }

  /// Whether the edge from vertex i bounds the polygon on the outside: it runs counter-clockwise about the
  /// zenith.
  [[nodiscard]] bool is_outer(std::size_t i) const { return outer_[i % size_]; }

 private:
  static Vec3d on_horizon(const Vec3d& a, const Vec3d& b) {
    const double part = a.z / (a.z - b.z);
    const Vec3d p = a + (b - a) * part;
    return {p.x, p.y, 0};
  }

  void add(const Vec3d& vertex, const Vec3d& plane) {
    direction_[size_] = azimuth(vertex);
    edge_[size_] = Ellipse(plane);
    outer_[size_] = plane.z > 0;
    ++size_;
  }

  std::size_t size_ = 0;
  std::array<Vec3d, 4> direction_;
  std::array<Ellipse, 4> edge_;  // from the vertex to the next
  std::array<bool, 4> outer_{};
};

ProjectedTriangle::ProjectedTriangle(const Triangle& triangle, const Vec3& x, const Vec3& n)
    : n_(normalize(Vec3d(n))) {
  s_ = tangent(n_);
  t_ = cross(n_, s_);
  const double side = side_of(triangle, x);
  if (side == 0) return;
  const auto seen = [&](const Vec3& vertex) {
    const Vec3d v = Vec3d(vertex) - Vec3d(x);
    return Vec3d(dot(v, s_), dot(v, t_), dot(v, n_));
  };
  const Polygon polygon = side < 0 ? Polygon({seen(triangle.v0), seen(triangle.v1), seen(triangle.v2)})
                                   : Polygon({seen(triangle.v0), seen(triangle.v2), seen(triangle.v1)});
  if (polygon.size() < 3) return;
  const std::size_t size = polygon.size();

  // The vertex of least azimuth: there the edges that bound the polygon on the inside end and those on the
  // outside begin. If the zenith lies within the polygon there is none.
  std::size_t first = 0;
  while (first < size && !(polygon.is_outer(first) && !polygon.is_outer(first + size - 1))) ++first;
  if (first == size) {
    if (!polygon.is_outer(0)) return;  // all of it is rounding
    for (std::size_t i = 0; i < size; ++i) {
      add_sector(polygon.direction(i), polygon.direction(i + 1), polygon.edge(i), Ellipse());
    }
    return;
  }
  // Go along both chains at once, to the vertex that comes next in azimuth, until they meet.
  std::size_t outer = first, inner = first + size;
  Vec3d from = polygon.direction(first);
  for (std::size_t step = 1; step < size; ++step) {
    const Ellipse &outside = polygon.edge(outer), &inside = polygon.edge(inner - 1);
    const Vec3d &on_outer = polygon.direction(outer + 1), &on_inner = polygon.direction(inner - 1);
    const bool outer_is_next = determinant(on_outer, on_inner) >= 0;
    const Vec3d to = outer_is_next ? on_outer : on_inner;
    outer_is_next ? ++outer : --inner;
    if (to == Vec3d(0)) continue;
    add_sector(from, to, outside, inside);
    from = to;
  }
}

void ProjectedTriangle::add_sector(const Vec3d& from, const Vec3d& to, const Ellipse& outer,
                                   const Ellipse& inner) {
  // Up to a quarter of a turn directions along the chord are spaced well.
  if (dot_in_plane(from, to) < -1e-9) {
    const Vec3d middle = normalize(Vec3d(to.y - from.y, from.x - to.x, 0));
    add_sector(from, middle, outer, inner);
    add_sector(middle, to, outer, inner);
    return;
  }
  Sector sector{from, to, outer, inner};
  sector.area = sector.area_up_to(to);
  if (!(sector.area > 0)) return;
  area_ += sector.area;
  sectors_[count_++] = sector;
}

Vec3d ProjectedTriangle::sample(const Vec2& u) const {
  double part = u.x * area_;
  std::size_t i = 0;
  while (i + 1 < count_ && part >= sectors_[i].area) part -= sectors_[i++].area;
  const Sector& sector = sectors_[i];
  const Vec3d d = sector.direction_at(std::min(part, sector.area));
  const double lowest = sector.outer.height2(d), highest = sector.inner.height2(d);
  const double height2 = highest + u.y * (lowest - highest);
  const double radius = std::sqrt(1 - height2);
  return s_ * (d.x * radius) + t_ * (d.y * radius) + n_ * std::sqrt(height2);
}

}  // namespace lemma
