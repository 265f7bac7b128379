#include "src/oracle/oracle.h"

#include <algorithm>
#include <limits>

#include "src/oracle/cluster.h"

namespace lemma {
namespace {

using Answer = Passage::Answer;

bool is_ray(const Ray& ray) {
  return is_finite(ray.origin) && is_finite(ray.direction) && ray.direction != Vec3(0) &&
         ray.t_min < ray.t_max;
}

Doubt doubt_of(const Passage& p) {
  if (p.grazing) return Doubt::grazing;
  const auto in_band = std::ranges::count(p.side, 0);
  if (in_band > 0) return in_band > 1 ? Doubt::vertex : Doubt::edge;
  return p.in_range == Answer::unsure ? Doubt::range_end : Doubt::tie;
}

/// Of the doubts about several answers the first in the order of Doubt: around a vertex there are edges, and
/// what is beside an edge ties with its neighbour.
Doubt doubt_of(std::span<const Passage> admissible) {
  Doubt doubt = Doubt::tie;
  for (const Passage& p : admissible) doubt = std::min(doubt, doubt_of(p));
  return doubt;
}

}  // namespace

std::string_view name_of(Doubt doubt) {
  constexpr std::array<std::string_view, kDoubts> names{"vertex", "edge", "grazing", "range end", "tie"};
  return names[static_cast<std::size_t>(doubt)];
}

Expectation Oracle::expect(const Ray& ray) const {
  Expectation expectation;
  if (!is_ray(ray)) return expectation;
  const LongRay long_ray(ray);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double reach = infinity;  // something must be hit by then
  std::vector<Passage>& near = expectation.admissible;
  bool edges = false;
  tree_.visit(long_ray, reach, [&](std::uint32_t i) {
    const Passage p = passage(long_ray, triangles_[i], i);
    if (p.inside == Answer::no && !p.touches_edge()) return;
    if (p.must_hit()) reach = std::min(reach, p.hi);
    edges |= p.touches_edge() && p.inside != Answer::no;
    near.push_back(p);
  });
  if (edges) reach = std::min(reach, covered_by(long_ray, triangles_, near));
  std::erase_if(near, [&](const Passage& p) { return !p.may_hit() || p.lo > reach; });

  expectation.must_hit = reach < infinity;
  const std::size_t answers = near.size() + (expectation.must_hit ? 0 : 1);
  if (answers > 1) expectation.doubt = doubt_of(near);
  std::vector<std::uint32_t> candidates;
  candidates.reserve(near.size());
  for (const Passage& p : near) candidates.push_back(p.triangle);
  expectation.exact = exact_hit(ray, triangles_, candidates);
  return expectation;
}

const Passage* Expectation::find(std::uint32_t triangle) const {
  const auto found = std::ranges::find(admissible, triangle, &Passage::triangle);
  return found == admissible.end() ? nullptr : &*found;
}

Verdict Expectation::judge(const std::optional<Hit>& hit) const {
  if (!hit) return must_hit ? Verdict::missed : Verdict::right;
  const Passage* p = find(hit->triangle);
  return p && p->lo <= hit->t && hit->t <= p->hi ? Verdict::right : Verdict::wrong;
}

Verdict Expectation::judge_occlusion(bool occluded) const {
  if (!occluded) return must_hit ? Verdict::missed : Verdict::right;
  return admissible.empty() ? Verdict::wrong : Verdict::right;
}

double Expectation::distance_error(const Hit& hit) const {
  const Passage* p = find(hit.triangle);
  return p && p->tolerance > 0 ? std::abs(hit.t - p->t) / p->tolerance : 0;
}

}  // namespace lemma
