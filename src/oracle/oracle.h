#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "src/core/hit.h"
#include "src/oracle/exact.h"
#include "src/oracle/triangle_tree.h"

namespace lemma {

/// Why float32 cannot decide a ray.
enum class Doubt { vertex, edge, grazing, range_end, tie };
inline constexpr std::size_t kDoubts = 5;

/// "vertex", "edge", "grazing", "range end", "tie".
[[nodiscard]] std::string_view name_of(Doubt doubt);

/// What a backend's answer to a ray is worth.
enum class Verdict {
  right,
  missed,  // no hit, where a triangle, or one of several around an edge or vertex, must be hit
  wrong    // a triangle that cannot be the nearest, or with a t beyond its bound
};

/// All that a sound float32 test may answer to a ray.
struct Expectation {
  bool must_hit = false;
  std::vector<Passage> admissible;  // the triangles that may be the answer
  std::optional<Doubt> doubt;       // nothing: decided, there is one answer
  std::optional<ExactHit> exact;    // the truth, in real arithmetic

  [[nodiscard]] Verdict judge(const std::optional<Hit>& hit) const;
  [[nodiscard]] Verdict judge_occlusion(bool occluded) const;

  /// How far t of a right answer is from the truth, in units of the bound.
  [[nodiscard]] double distance_error(const Hit& hit) const;

 private:
  [[nodiscard]] const Passage* find(std::uint32_t triangle) const;
};

/// Knows which triangle a ray hits first, and when float32 cannot know. Thread-safe.
class Oracle {
 public:
  /// @param triangles  outlive the oracle
  explicit Oracle(std::span<const Triangle> triangles) : triangles_(triangles), tree_(triangles) {}

  /// @param ray  if it is not finite, has no direction or an empty range, nothing may be hit
  [[nodiscard]] Expectation expect(const Ray& ray) const;

 private:
  std::span<const Triangle> triangles_;
  TriangleTree tree_;
};

}  // namespace lemma
