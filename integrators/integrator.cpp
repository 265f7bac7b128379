#include "integrators/integrator.h"

namespace lemma {

namespace {

class PathByPath final : public WaveIntegrator {
 public:
  PathByPath(const Integrator& integrator, const World& world) : integrator_(integrator), world_(world) {}

  void radiances(const RayWave& rays, const HitWave& first, std::size_t count, Tracer& tracer,
                 const SamplerWave& random, RgbWave& radiance) override {
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<Hit> hit = first.is_hit(i) ? std::optional(first[i]) : std::nullopt;
      Sampler of_lane = random[i];
      radiance.set(i, integrator_.radiance(rays[i], hit, world_, tracer, of_lane));
    }
  }

 private:
  const Integrator& integrator_;
  const World world_;
};

}  // namespace

std::unique_ptr<WaveIntegrator> Integrator::waves(const World& world) const {
  return std::make_unique<PathByPath>(*this, world);
}

// The table of integrators: a new one is a file that defines make_ID, and a line here.
#define LEMMA_INTEGRATORS(entry)                                                                            \
  entry(mis, "mis",                                                                                         \
        "light and BRDF samples, weighted by multiple importance sampling (the report's 7.3, as one path)") \
      entry(direct, "direct",                                                                               \
            "light samples for direct, BRDF samples for indirect light (the report's 7.1)")                 \
          entry(brdf, "brdf", "BRDF samples only (the report's 7.2)")                                       \
              entry(mis_report, "mis-report",                                                               \
                    "the report's eq. (11) as it stands: both samples of all light that arrives, weighted")

#define LEMMA_DECLARE(id, name, help) \
  std::unique_ptr<const Integrator> make_##id(const Model&, const IntegratorOptions&);
LEMMA_INTEGRATORS(LEMMA_DECLARE)

std::span<const Named<IntegratorFactory>> integrators() {
#define LEMMA_ENTRY(id, name, help) {name, make_##id, help},
  static constexpr Named<IntegratorFactory> table[] = {LEMMA_INTEGRATORS(LEMMA_ENTRY)};
  return table;
}

}  // namespace lemma
