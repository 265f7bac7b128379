#include "src/lights/body_trace.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "src/core/instruction_sets.h"
#include "src/lights/face_crossing.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/lights/body_trace.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, BodyMesh::kWidth>;
using Floats = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;
constexpr Lanes kLanes;
constexpr double kRounding = 0x1p-24;

HWY_INLINE std::uint32_t bits_of(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kLanes, mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

struct Vectors {
  Floats x, y, z;
};

HWY_INLINE Floats dot(const Vectors& a, const Vectors& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// One ray through one mesh.
class Search {
 public:
  /// The part of the ray that counts starts where it is nearest to the centre, two radii back.
  HWY_INLINE Search(const BodyMesh& mesh, const Vec3& x, const Vec3d& w) : mesh_(mesh), w_(w) {
    const Vec3d to_centre = mesh.centre - Vec3d(x);
    const double skipped = lemma::dot(to_centre, w) - 2 * mesh.radius;
    start_ = Vec3d(x) + w * skipped;
    origin_ = Vec3(w * skipped - to_centre);
    direction_ = Vec3(w);
    for (int k = 0; k < 3; ++k) {
      constexpr double least = 1e-30;  // 0 times infinity would be no number
      inverse_[k] = static_cast<float>(1 / (std::abs(w[k]) < least ? std::copysign(least, w[k]) : w[k]));
    }
    // Along 4 radii the rounding of the direction moves the ray by 4 roundings of the radius, those of origin
    // and boxes by 4, the arithmetic by some.
    slack_ = static_cast<float>(32 * kRounding * mesh.radius);
    // A volume w . (b x c), where b and c have lengths up to 4 radii and err by 4 roundings of the radius:
    // 2 * 4 * 4 for the product, 6 * 16 for its arithmetic, 16 for w.
    volume_slack_ = static_cast<float>(256 * kRounding * mesh.radius * mesh.radius);
  }

  HWY_INLINE std::optional<BodyMesh::Point> operator()() {
    visit(mesh_.root);
    if (nearest_ == std::numeric_limits<double>::infinity()) return std::nullopt;
    return found_;
  }

 private:
  void visit(std::uint32_t child) {
    if ((child & BodyMesh::kLeafBit) != 0) {
      visit_leaf(mesh_.leaves[child & ~BodyMesh::kLeafBit]);
    } else {
      visit_inner(mesh_.inners[child]);
    }
  }

  /// The children that the ray passes, the nearest first.
  void visit_inner(const BodyMesh::Inner& node) {
    alignas(64) BodyMesh::Values entries;
    std::uint32_t passed = enter_boxes(node, entries);
    while (passed != 0) {
      std::size_t first = static_cast<std::size_t>(std::countr_zero(passed));
      for (std::uint32_t rest = passed & (passed - 1); rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        if (entries[i] < entries[first]) first = i;
      }
      if (entries[first] > nearest_) return;
      passed &= ~(1u << first);
      visit(node.child[first]);
    }
  }

  /// Where the ray enters the children's boxes, enlarged by the slack; returns which of them it passes.
  HWY_INLINE std::uint32_t enter_boxes(const BodyMesh::Inner& node, BodyMesh::Values& entries) const {
    std::uint32_t passed = 0;
    for (std::size_t i = 0; i < BodyMesh::kWidth; i += hn::Lanes(kLanes)) {
      Floats enter = hn::Zero(kLanes), leave = hn::Set(kLanes, std::numeric_limits<float>::infinity());
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<int>(k);
        const bool backwards = inverse_[axis] < 0;
        const Floats near = hn::LoadU(kLanes, (backwards ? node.hi : node.lo)[k].data() + i),
                     far = hn::LoadU(kLanes, (backwards ? node.lo : node.hi)[k].data() + i);
        const float slack = backwards ? -slack_ : slack_;
        const Floats inverse = hn::Set(kLanes, inverse_[axis]);
        const Floats in = hn::Mul(hn::Sub(near, hn::Set(kLanes, origin_[axis] + slack)), inverse),
                     out = hn::Mul(hn::Sub(far, hn::Set(kLanes, origin_[axis] - slack)), inverse);
        enter = hn::Max(enter, in);
        leave = hn::Min(leave, out);
      }
      hn::StoreU(enter, kLanes, entries.data() + i);
      passed |= bits_of(hn::Le(enter, leave)) << i;
    }
    return passed;
  }

  void visit_leaf(const BodyMesh::Leaf& leaf) {
    for (std::size_t i = 0; i < BodyMesh::kWidth; i += hn::Lanes(kLanes)) {
      for (std::uint32_t rest = candidates(leaf, i); rest != 0; rest &= rest - 1) {
        decide(leaf.emitter[i + static_cast<std::size_t>(std::countr_zero(rest))]);
      }
    }
  }

  /// Triangles that may face the ray and be crossed by it: from outside, the first of a closed mesh does.
  HWY_INLINE std::uint32_t candidates(const BodyMesh::Leaf& leaf, std::size_t i) const {
    const auto corner = [&](std::size_t k) {
      const auto relative = [&](std::size_t axis) {
        return hn::Sub(hn::LoadU(kLanes, leaf.corners[3 * k + axis].data() + i),
                       hn::Set(kLanes, origin_[static_cast<int>(axis)]));
      };
      return Vectors{relative(0), relative(1), relative(2)};
    };
    const Vectors a = corner(0), b = corner(1), c = corner(2);
    const Vectors w{hn::Set(kLanes, direction_.x), hn::Set(kLanes, direction_.y),
                    hn::Set(kLanes, direction_.z)};
    const Floats at_a = dot(w, cross(b, c)), at_b = dot(w, cross(c, a)), at_c = dot(w, cross(a, b));
    return bits_of(hn::Le(hn::Max(hn::Max(at_a, at_b), at_c), hn::Set(kLanes, volume_slack_)));
  }

  /// Whether the ray crosses the triangle, by the signs of the volumes that it spans with the edges; and
  /// whether nearer than what was found before. Of two at the same distance the one of lower index counts.
  void decide(std::uint32_t emitter) {
    const FaceCrossing crossing(mesh_.emitters[emitter].shape, start_, w_);
    if (!crossing.passes_to_back() || crossing.sum() == 0) return;
    const Vec3d y = crossing.point();
    const double distance = lemma::dot(y, w_);
    if (distance > nearest_ || (distance == nearest_ && emitter >= found_.emitter)) return;
    nearest_ = distance;
    found_ = {emitter, y + start_};
  }

  const BodyMesh& mesh_;
  const Vec3d& w_;
  Vec3d start_;                        // of the part of the ray that counts
  Vec3 origin_, direction_, inverse_;  // relative to the centre
  float slack_, volume_slack_;
  double nearest_ = std::numeric_limits<double>::infinity();
  BodyMesh::Point found_{0, Vec3d(0)};
};

std::optional<BodyMesh::Point> first_hit(const BodyMesh& mesh, const Vec3& x, const Vec3d& w) {
  return Search(mesh, x, w)();
}

}  // namespace

BodyTrace body_trace() {
  return {first_hit, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(body_trace);

const std::vector<BodyTrace>& body_traces() {
  static const std::vector<BodyTrace> traces =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(body_trace)(); });
  return traces;
}

}  // namespace lemma
#endif
