#include "tests/hard/hard_case.h"

#include "src/oracle/oracle.h"
#include "src/parity/ray_kinds.h"

namespace lemma::test {

std::unique_ptr<const Accelerator> make_backend(std::string_view name, std::span<const Triangle> triangles) {
  return find_named(accelerators(), name).value()(triangles, {});
}

Outcome judge(std::string_view backend, const std::vector<Triangle>& triangles,
              const std::vector<Ray>& rays) {
  const auto accel = make_backend(backend, triangles);
  const Oracle oracle(triangles);
  Outcome outcome{.rays = rays.size()};
  for (const Ray& ray : rays) {
    const Expectation expected = oracle.expect(ray);
    const auto hit = accel->closest_hit(ray);
    const bool right = expected.judge(hit) == Verdict::right &&
                       expected.judge_occlusion(accel->occluded(ray)) == Verdict::right;
    outcome.faults += right ? 0 : 1;
  }
  return outcome;
}

std::vector<Ray> rays_of_all_kinds(const std::vector<Triangle>& triangles, std::uint32_t count) {
  const auto walker = make_backend("grid", triangles);
  const RaySource source({.triangles = triangles, .walker = walker.get()}, 61);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) rays.push_back(source.draw(i));
  return rays;
}

}  // namespace lemma::test
