#include <fmt/format.h>

#include "accel/accelerator.h"
#include "accel/watertight.h"

namespace lemma {
namespace {

class Brute final : public Accelerator {
 public:
  explicit Brute(std::span<const Triangle> triangles) : triangles_(triangles) {}

  std::optional<Hit> closest_hit(const Ray& ray) const override {
    const ShearedRay sheared(ray);
    Hit best = no_hit(sheared);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) intersect(sheared, triangles_[i], i, best);
    if (best.t < ray.t_max) return best;
    return std::nullopt;
  }

  bool occluded(const Ray& ray) const override {
    const ShearedRay sheared(ray);
    Hit best = no_hit(sheared);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      if (intersect(sheared, triangles_[i], i, best)) return true;
    }
    return false;
  }

  std::size_t memory_bytes() const override { return 0; }

  std::string description() const override {
    return fmt::format("brute force over {} triangles", triangles_.size());
  }

 private:
  std::span<const Triangle> triangles_;
};

}  // namespace

std::unique_ptr<const Accelerator> make_brute(std::span<const Triangle> triangles,
                                              const AcceleratorOptions&) {
  return std::make_unique<Brute>(triangles);
}

}  // namespace lemma
