#include "src/render/camera_rays.h"

#include "src/core/instruction_sets.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/render/camera_rays.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

/// A plain loop without branches, that compilers turn into vector code of the instruction set.
void aim(const Camera& camera, const PixelBlock& pixels, std::uint32_t reversed_index,
         PixelBlock::Directions& directions) {
  for (std::size_t i = 0; i < PixelBlock::kSize; ++i) {
    const Vec2 u = Sampler::pair_of(reversed_index, {pixels.order[i], pixels.key_x[i], pixels.key_y[i]});
    const int x = pixels.x + static_cast<int>(i);
    const Vec3 d = camera.direction_through(static_cast<float>(x) + u.x, static_cast<float>(pixels.y) + u.y);
    directions.x[i] = d.x, directions.y[i] = d.y, directions.z[i] = d.z;
  }
}

}  // namespace

AimRays aim_rays() {
  return {aim, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {
namespace {

HWY_EXPORT(aim_rays);

}  // namespace

const std::vector<AimRays>& all_aim_rays() {
  static const std::vector<AimRays> all =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(aim_rays)(); });
  return all;
}

CameraRays::CameraRays(const Camera& camera, const RenderSettings& settings, int x, int y, std::size_t count,
                       std::size_t lane)
    : camera_(camera),
      settings_(settings),
      count_(count),
      lane_(lane),
      aim_(HWY_DYNAMIC_DISPATCH(aim_rays)().function),
      replicate_(settings.replicates) {  // that of no sample
  pixels_.x = x, pixels_.y = y;
}

void CameraRays::aim(std::uint32_t sample, VecWave& directions, SamplerWave& random) {
  if (settings_.sequence == Sequence::independent) return aim_independent(sample, directions, random);
  if (const std::uint32_t replicate = sample % settings_.replicates; replicate != replicate_) {
    replicate_ = replicate;
    for (std::size_t i = 0; i < count_; ++i) {
      Sampler of_pixel = start(i, sample);
      pixels_.set(i, of_pixel.next_pair_keys());
      random.set(lane_ + i, of_pixel);
    }
  }
  const std::uint32_t reversed_index = reverse_bits(sample / settings_.replicates);
  random.set_sample(reversed_index);
  PixelBlock::Directions to;
  aim_(camera_, pixels_, reversed_index, to);
  for (std::size_t i = 0; i < count_; ++i) directions.set(lane_ + i, {to.x[i], to.y[i], to.z[i]});
}

void CameraRays::aim_independent(std::uint32_t sample, VecWave& directions, SamplerWave& random) {
  for (std::size_t i = 0; i < count_; ++i) {
    Sampler of_pixel = start(i, sample);
    const Vec2 u = of_pixel.next_2d();
    const int x = pixels_.x + static_cast<int>(i);
    directions.set(
        lane_ + i,
        camera_.ray_through(static_cast<float>(x) + u.x, static_cast<float>(pixels_.y) + u.y).direction);
    random.set(lane_ + i, of_pixel);
  }
}

/// Up to 65536 x 65536 pixels.
Sampler CameraRays::start(std::size_t i, std::uint32_t sample) const {
  const auto x = static_cast<std::uint32_t>(pixels_.x) + static_cast<std::uint32_t>(i);
  const std::uint32_t pixel =
      static_cast<std::uint32_t>(pixels_.y) * static_cast<std::uint32_t>(camera_.width()) + x;
  return {settings_.seed, pixel, sample, settings_.sequence, settings_.replicates};
}

}  // namespace lemma
#endif
