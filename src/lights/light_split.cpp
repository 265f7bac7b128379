#include "src/lights/light_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace lemma {
namespace {

constexpr std::size_t kBins = 12;
constexpr double kPi = std::numbers::pi;
constexpr double kHalfPi = kPi / 2;

float centre(const LightItem& item, int axis) {
  return 0.5f * (item.bounds.box.lo[axis] + item.bounds.box.hi[axis]);
}

/// The integral over all directions of the cosine to the nearest normal of the cone: Conty and Kulla 2018,
/// eq. (1), for emitters that reach a hemisphere.
double reach(double spread) {
  const double edge = std::min(spread + kHalfPi, kPi);
  return 2 * kPi * (1 - std::cos(spread)) +
         kHalfPi * (2 * edge * std::sin(spread) - std::cos(spread - 2 * edge) -
                    2 * spread * std::sin(spread) + std::cos(spread));
}

double surface(const Bounds& box) {
  const Vec3d size = Vec3d(box.hi) - Vec3d(box.lo);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

double cost(const LightBounds& side) {
  return side.power * surface(side.box) * reach(side.spread);
}

using Side = std::optional<LightBounds>;

Side united(const Side& a, const Side& b) {
  if (!a) return b;
  return b ? LightBounds(*a, *b) : *a;
}

/// The bins along one axis.
struct Binning {
  int axis;
  float lo, scale;

  Binning(std::span<const LightItem> items, int along) : axis(along) {
    const auto [least, most] =
        std::ranges::minmax(items, {}, [&](const LightItem& item) { return centre(item, along); });
    lo = centre(least, along);
    scale = static_cast<float>(kBins) / (centre(most, along) - lo);
  }
  /// Whether the items' centres differ along the axis.
  [[nodiscard]] bool exists() const { return std::isfinite(scale); }
  [[nodiscard]] std::size_t bin(const LightItem& item) const {
    return std::min(static_cast<std::size_t>((centre(item, axis) - lo) * scale), kBins - 1);
  }
};

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  std::optional<Binning> binning;
  std::size_t first_of_second = 0;  // bin
};

void try_axis(std::span<const LightItem> items, int axis, double length_factor, Split& best) {
  const Binning binning(items, axis);
  if (!binning.exists()) return;
  std::array<Side, kBins> bins;
  for (const LightItem& item : items) bins[binning.bin(item)] = united(bins[binning.bin(item)], item.bounds);
  std::array<Side, kBins> from;  // what lies in a bin and all after it
  for (std::size_t i = kBins; i-- > 0;) from[i] = united(bins[i], i + 1 < kBins ? from[i + 1] : Side());
  Side before;
  for (std::size_t i = 1; i < kBins; ++i) {
    before = united(before, bins[i - 1]);
    if (!before || !from[i]) continue;
    const double c = length_factor * (cost(*before) + cost(*from[i]));
    if (c < best.cost) best = {c, binning, i};
  }
}

}  // namespace

std::size_t split_lights(std::span<LightItem> items) {
  Bounds box;
  for (const LightItem& item : items) {
    box.add(item.bounds.box.lo);
    box.add(item.bounds.box.hi);
  }
  const Vec3 size = box.hi - box.lo;
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] > 0) try_axis(items, axis, double{max_norm(size)} / size[axis], best);  // thin boxes cost
  }
  if (!best.binning) return items.size() / 2;
  const auto in_first = [&](const LightItem& item) { return best.binning->bin(item) < best.first_of_second; };
  return static_cast<std::size_t>(std::partition(items.begin(), items.end(), in_first) - items.begin());
}

}  // namespace lemma
