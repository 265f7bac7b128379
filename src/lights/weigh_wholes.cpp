#include "src/lights/weigh_wholes.h"

#include "src/core/instruction_sets.h"
#include "src/lights/whole_weight.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/lights/weigh_wholes.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t kLanes =
    hwy::HWY_NAMESPACE::MaxLanes(hwy::HWY_NAMESPACE::CappedTag<float, WholeBlock::kSize>());

/// The inner loop is one vector of the instruction set.
void weigh(const WholeBlock& block, std::size_t count, const LightQuery& at, WholeBlock::Values& weights) {
  const Vec3 x = at.x, n = at.n;
  const Reflection reflection = at.reflection;
  for (std::size_t first = 0; first < count; first += kLanes) {
    for (std::size_t i = first; i < first + kLanes; ++i)
      weights[i] = whole_weight(block[i], x, n, reflection);
  }
}

}  // namespace

WeighWholes weigh_wholes() {
  return {weigh, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(weigh_wholes);

const std::vector<WeighWholes>& all_weigh_wholes() {
  static const std::vector<WeighWholes> all =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(weigh_wholes)(); });
  return all;
}

WholeOutline outline_of(const WholeLight& light, float radiance_luminance) {
  const Vec3 centre(light.centre);
  return {centre, Vec3(light.centre - Vec3d(centre)), static_cast<float>(light.radius * light.radius),
          radiance_luminance};
}

void WholeBlock::set(std::size_t place, const WholeLight& light, float radiance_luminance) {
  const auto [centre, rest, light_radius2, light_luminance] = outline_of(light, radiance_luminance);
  x[place] = centre.x, y[place] = centre.y, z[place] = centre.z;
  rest_x[place] = rest.x, rest_y[place] = rest.y, rest_z[place] = rest.z;
  radius2[place] = light_radius2;
  luminance[place] = light_luminance;
}

}  // namespace lemma
#endif
