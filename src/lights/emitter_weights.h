#pragma once

#include <span>
#include <vector>

#include "src/core/vec.h"
#include "src/lights/emitter.h"

namespace lemma {

/// Weights of all emitters as seen from a point: luminance x solid angle of those that emit towards it, in
/// float32. They serve as probabilities only, so their error makes no bias; sampling and density use the same
/// function and see the same bits. Kept as structure of arrays, so that the compiler works on several
/// emitters at a time.
class EmitterWeights {
 public:
  explicit EmitterWeights(std::span<const Emitter> emitters);

  /// Weight of one emitter.
  [[nodiscard]] float weight(const Vec3& x, std::size_t emitter) const;

  /// Sum over all emitters, added in blocks.
  [[nodiscard]] double total(const Vec3& x) const;

  /// The emitter at which the running sum of weights passes `target`, in [0, total(x)); never one of weight 0
  /// while any is above.
  [[nodiscard]] std::size_t find(const Vec3& x, double target) const;

 private:
  static constexpr std::size_t kBlock = 64;
  [[nodiscard]] std::size_t weigh_block(const Vec3& x, std::size_t begin,
                                        std::span<float, kBlock> weights) const;

  // Vertex v0, the other two, area vector, luminance: one entry an emitter.
  std::vector<float> v0_x_, v0_y_, v0_z_, v1_x_, v1_y_, v1_z_, v2_x_, v2_y_, v2_z_, n_x_, n_y_, n_z_,
      luminance_;
};

}  // namespace lemma
