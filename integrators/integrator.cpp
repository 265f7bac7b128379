#include "integrators/integrator.h"

namespace lemma {

// The table of integrators: a new one is a file that defines make_NAME, and a line here.
#define LEMMA_INTEGRATORS(entry)                                                                            \
  entry(mis,                                                                                                \
        "light and BRDF samples, weighted by multiple importance sampling (the report's 7.3, as one path)") \
      entry(direct, "light samples for direct, BRDF samples for indirect light (the report's 7.1)")         \
          entry(brdf, "BRDF samples only (the report's 7.2)")

#define LEMMA_DECLARE(name, help) \
  std::unique_ptr<const Integrator> make_##name(const Model&, const IntegratorOptions&);
LEMMA_INTEGRATORS(LEMMA_DECLARE)

std::span<const Named<IntegratorFactory>> integrators() {
#define LEMMA_ENTRY(name, help) {#name, make_##name, help},
  static constexpr Named<IntegratorFactory> table[] = {LEMMA_INTEGRATORS(LEMMA_ENTRY)};
  return table;
}

}  // namespace lemma
