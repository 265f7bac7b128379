#include "bench/embree_rate.h"

#include <ctime>

#include "bench/cases.h"
#include "src/core/parallel.h"

namespace lemma::bench {
namespace {

constexpr RaySize kSize{320, 180};  // few rays: recording them takes longer than tracing them
constexpr std::size_t kPasses = 3;  // of each thread

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

double embree_rate(const std::string& case_name) {
  const Case scene = make_case(case_name);
  const auto embree = find_named(accelerators(), "embree").value()(scene.triangles, {});
  const RecordedRays rays = record_rays(scene, *embree, kSize);
  const auto trace_once = [&] {
    std::size_t count = 0;
    for (const Named<RayKind>& kind : ray_kinds()) {
      if (kind.value.asked != Asked::single) continue;
      trace(*embree, rays, kind.value);
      count += (rays.*kind.value.rays).size();
    }
    return count;
  };
  const std::size_t count = trace_once();  // also fills the caches
  const std::size_t passes = kPasses * static_cast<std::size_t>(ThreadLimit(0).threads());
  const double start = processor_seconds();
  parallel_for(passes, [&](std::size_t) { trace_once(); });
  return static_cast<double>(passes * count) / (processor_seconds() - start);
}

}  // namespace lemma::bench
