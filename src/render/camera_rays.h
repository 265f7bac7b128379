#pragma once

#include <array>
#include <vector>

#include "src/core/sampler_wave.h"
#include "src/render/render.h"

namespace lemma {

/// Up to 16 neighbouring pixels of a row: the keys of their samples' first pair, as structure of arrays.
struct PixelBlock {
  static constexpr std::size_t kSize = 16;
  using Words = std::array<std::uint32_t, kSize>;
  using Values = std::array<float, kSize>;

  int x = 0, y = 0;  // of the first pixel
  Words order{}, key_x{}, key_y{};

  void set(std::size_t i, const Sampler::PairKeys& keys) {
    order[i] = keys.order, key_x[i] = keys.x, key_y[i] = keys.y;
  }

  /// Unit, of a camera ray through each pixel.
  struct Directions {
    alignas(64) Values x, y, z;
  };
};

/// Camera::direction_through() of the points that Sampler::pair_of() chooses within a block's pixels,
/// compiled for one instruction set.
struct AimRays {
  void (*function)(const Camera& camera, const PixelBlock& pixels, std::uint32_t reversed_index,
                   PixelBlock::Directions& directions);
  const char* name;  // "AVX2"
};

/// Those that this machine can run, the fastest first. All give the same directions, bit for bit.
[[nodiscard]] const std::vector<AimRays>& all_aim_rays();

/// Camera rays of a block of pixels, one sample of each at a time, in lanes of a wave that lie together.
class CameraRays {
 public:
  /// Keeps a reference to the camera.
  /// @param count  of pixels from (x, y) on, up to PixelBlock::kSize
  /// @param lane   of the first pixel
  CameraRays(const Camera& camera, const RenderSettings& settings, int x, int y, std::size_t count,
             std::size_t lane);

  /// Goes to the sample of this index. The same as Sampler::next_2d() and the direction of
  /// Camera::ray_through() of each pixel.
  /// @param random  of the samples after the first pair; what is in it stays from call to call
  void aim(std::uint32_t sample, VecWave& directions, SamplerWave& random);

 private:
  [[nodiscard]] Sampler start(std::size_t i, std::uint32_t sample) const;
  void aim_independent(std::uint32_t sample, VecWave& directions, SamplerWave& random);

  const Camera& camera_;
  RenderSettings settings_;
  std::size_t count_, lane_;
  decltype(AimRays::function) aim_;  // the fastest
  PixelBlock pixels_;
  std::uint32_t replicate_;  // that was last seen
};

}  // namespace lemma
