#include "src/lights/convex_walk.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "src/lights/face_crossing.h"

namespace lemma {
namespace {

// A vertex this part of the radius before the plane of a neighbour is a rounding of the file: of the rays
// that enter, some 10^-4 can then pass two front faces, whose radiance and density are the same.
constexpr double kRoundedDent = 1e-4;
// From a start at the right direction a walk takes one or two steps, at the silhouette some more.
constexpr int kMostSteps = 16;

const Vec3& corner(const Triangle& t, std::size_t k) {
  return k == 0 ? t.v0 : k == 1 ? t.v1 : t.v2;
}

/// An edge of a face, in the direction of its winding.
struct Edge {
  std::array<float, 6> ends;
  std::uint32_t face;
  std::size_t opposite;  // the corner that it does not meet
};

std::array<float, 6> ends_of(const Vec3& from, const Vec3& to) {
  return {from.x, from.y, from.z, to.x, to.y, to.z};
}

}  // namespace

std::optional<ConvexWalk> ConvexWalk::find(std::span<const Emitter> emitters, const WholeLight& light) {
  ConvexWalk walk(emitters, light);
  if (walk.has_dent(emitters)) return std::nullopt;
  walk.find_starts(emitters);
  return walk;
}

ConvexWalk::ConvexWalk(std::span<const Emitter> emitters, const WholeLight& light)
    : centre_(light.centre),
      radius_(light.radius),
      resolution_(
          static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(light.emitters.size()) / 6)))) {
  faces_.reserve(light.emitters.size());
  for (const std::uint32_t e : light.emitters) faces_.push_back({e, {}});
  join_faces(emitters);
}

/// Each edge of a closed body belongs to two faces, once in each direction.
void ConvexWalk::join_faces(std::span<const Emitter> emitters) {
  std::vector<Edge> edges;
  edges.reserve(3 * faces_.size());
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const Triangle& t = emitters[faces_[f].emitter].shape;
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back({ends_of(corner(t, (k + 1) % 3), corner(t, (k + 2) % 3)), f, k});
    }
  }
  std::ranges::sort(edges, {}, &Edge::ends);
  for (const Edge& edge : edges) {
    const auto& e = edge.ends;
    const std::array<float, 6> reversed{e[3], e[4], e[5], e[0], e[1], e[2]};
    faces_[edge.face].across[edge.opposite] =
        std::ranges::lower_bound(edges, reversed, {}, &Edge::ends)->face;
  }
}

bool ConvexWalk::has_dent(std::span<const Emitter> emitters) const {
  return std::ranges::any_of(faces_, [&](const Face& face) {
    const Triangle& t = emitters[face.emitter].shape;
    const double highest = kRoundedDent * radius_ * length(area_vector(t));
    return std::ranges::any_of(face.across, [&](std::uint32_t neighbour) {
      const Triangle& other = emitters[faces_[neighbour].emitter].shape;
      return std::max({side_of(t, other.v0), side_of(t, other.v1), side_of(t, other.v2)}) > highest;
    });
  });
}

/// Walks from cell to cell, along rays from the centre; if it went astray, the start would only be a bad one.
void ConvexWalk::find_starts(std::span<const Emitter> emitters) {
  starts_.reserve(6 * resolution_ * resolution_);
  std::uint32_t face = 0;
  for (int side = 0; side < 6; ++side) {
    for (std::size_t i = 0; i < resolution_ * resolution_; ++i) {
      const auto middle = [&](std::size_t cell) {
        return (2 * static_cast<double>(cell) + 1) / static_cast<double>(resolution_) - 1;
      };
      Vec3d direction;
      direction[side / 2] = side % 2 == 0 ? 1 : -1;
      direction[(side / 2 + 1) % 3] = middle(i % resolution_);
      direction[(side / 2 + 2) % 3] = middle(i / resolution_);
      for (std::size_t steps = 0; steps < 16 * resolution_; ++steps) {
        const FaceCrossing crossing(emitters[faces_[face].emitter].shape, centre_, direction);
        const auto least = std::ranges::min_element(crossing.opposite);
        if (*least >= 0) break;
        face = faces_[face].across[static_cast<std::size_t>(least - crossing.opposite.begin())];
      }
      starts_.push_back(face);
    }
  }
}

std::size_t ConvexWalk::cell_of(const Vec3d& d) const {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  const int axis = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
  const double scale = 0.5 * static_cast<double>(resolution_) / std::abs(d[axis]);
  const auto cell = [&](double along) {
    return std::min(static_cast<std::size_t>(along * scale + 0.5 * static_cast<double>(resolution_)),
                    resolution_ - 1);
  };
  const std::size_t side = 2 * static_cast<std::size_t>(axis) + (d[axis] < 0 ? 1 : 0);
  return (side * resolution_ + cell(d[(axis + 2) % 3])) * resolution_ + cell(d[(axis + 1) % 3]);
}

std::optional<BodyPoint> ConvexWalk::enter(std::span<const Emitter> emitters, const Vec3& x,
                                           const Vec3d& w) const {
  const Vec3d to_centre = centre_ - Vec3d(x);
  const double along = dot(to_centre, w);
  const Vec3d start = Vec3d(x) + w * (along - 2 * radius_);
  // From the centre to where the ray enters the sphere.
  const Vec3d nearest = w * along - to_centre;
  const Vec3d entry = nearest - w * std::sqrt(std::max(0.0, radius_ * radius_ - dot(nearest, nearest)));
  std::uint32_t face = starts_[cell_of(entry)];
  for (int step = 0; step < kMostSteps; ++step) {
    const FaceCrossing crossing(emitters[faces_[face].emitter].shape, start, w);
    if (!(crossing.sum() < 0)) return std::nullopt;
    if (crossing.passes_to_back()) return BodyPoint{faces_[face].emitter, crossing.point() + start};
    const auto most = std::ranges::max_element(crossing.opposite);
    face = faces_[face].across[static_cast<std::size_t>(most - crossing.opposite.begin())];
  }
  return std::nullopt;
}

}  // namespace lemma
