#pragma once

#include <array>
#include <span>
#include <vector>

#include "src/core/vec.h"
#include "src/lights/emitter.h"

namespace lemma {

/// Weights of all emitters as seen from a point: luminance x solid angle of those that emit towards it, in
/// float32. They serve as probabilities only, so their error makes no bias; sampling and density use the same
/// function and see the same bits.
class EmitterWeights {
 public:
  explicit EmitterWeights(std::span<const Emitter> emitters);

  /// Weight of one emitter.
  [[nodiscard]] float weight(const Vec3& x, std::size_t emitter) const;

  /// Sum over all emitters.
  [[nodiscard]] double total(const Vec3& x) const;

  /// The emitter at which the running sum of weights passes `target`, in [0, total(x)); never one of weight 0
  /// while any is above.
  [[nodiscard]] std::size_t find(const Vec3& x, double target) const;

 private:
  static constexpr std::size_t kBlock = 64;

  /// Some emitters, as structure of arrays, so that the compiler works on several at a time. Places left over
  /// hold emitters of luminance 0.
  struct Block {
    std::array<float, kBlock> v0_x{}, v0_y{}, v0_z{}, v1_x{}, v1_y{}, v1_z{}, v2_x{}, v2_y{}, v2_z{};
    std::array<float, kBlock> normal_x{}, normal_y{}, normal_z{};  // area vector
    std::array<float, kBlock> luminance{};
  };
  static float weigh(const Block& block, const Vec3& x, std::size_t i);
  static std::array<float, kBlock> weigh_all(const Block& block, const Vec3& x);

  std::vector<Block> blocks_;
};

}  // namespace lemma
