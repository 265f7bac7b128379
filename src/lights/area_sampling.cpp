#include "src/lights/area_sampling.h"

#include <vector>

#include "src/core/alias_table.h"
#include "src/core/warp.h"
#include "src/lights/connection.h"

namespace lemma {
namespace {

class AreaSampler final : public LightSampler {
 public:
  AreaSampler(std::span<const Emitter> emitters, std::span<const double> weights)
      : emitters_(emitters), choice_(weights) {
    density_.reserve(emitters.size());
    for (std::uint32_t i = 0; i < emitters.size(); ++i) {
      density_.push_back({static_cast<float>(choice_.pmf(i) / area(emitters[i].shape))});
    }
  }

  std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const override {
    const std::uint32_t i = choice_.sample(random.next_bits());
    const auto [b1, b2] = uniform_triangle(random.next_2d());
    const auto connection = connect(emitters_[i], at.x, point_at(emitters_[i].shape, b1, b2));
    if (!connection) return std::nullopt;
    return make_light_sample(emitters_, i, at.x, *connection, density(i, *connection));
  }

  PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter, const Vec3& y) const override {
    const auto connection = connect(emitters_[emitter], at.x, Vec3d(y));
    return connection ? density(emitter, *connection) : PdfSolidAngle{0};
  }

 private:
  [[nodiscard]] PdfSolidAngle density(std::uint32_t emitter, const Connection& c) const {
    return to_solid_angle(density_[emitter], c.distance2, c.cos_light);
  }

  std::span<const Emitter> emitters_;
  AliasTable choice_;
  std::vector<PdfArea> density_;  // probability of the emitter / its area
};

}  // namespace

std::unique_ptr<const LightSampler> make_area_sampler(std::span<const Emitter> emitters,
                                                      std::span<const double> weights) {
  return std::make_unique<AreaSampler>(emitters, weights);
}

}  // namespace lemma
