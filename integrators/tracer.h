#pragma once

#include <x86intrin.h>

#include <cstdint>
#include <type_traits>

#include "accel/accelerator.h"
#include "src/lights/light_sampler.h"

namespace lemma {

/// What tracing one part of an image took; summed over the parts at the end.
struct TraceCounts {
  std::uint64_t rays = 0;             // closest-hit and occlusion queries
  std::uint64_t paths_cut = 0;        // paths ended by the depth limit while still alive
  std::uint64_t traversal_ticks = 0;  // processor ticks within the accelerator ...
  std::uint64_t timed_ticks = 0;      // ... of so many in all, over the samples that were timed

  TraceCounts& operator+=(const TraceCounts& o) {
    rays += o.rays, paths_cut += o.paths_cut, traversal_ticks += o.traversal_ticks,
        timed_ticks += o.timed_ticks;
    return *this;
  }
};

/// One thread's way to the accelerator: asks it, and counts. While a Timing lives it also measures the share
/// of the time that is spent there; reading the clock costs about as much as a tenth of a ray, so only a few
/// samples are timed.
class Tracer {
 public:
  explicit Tracer(const Accelerator& accel) : accel_(accel) {}

  [[nodiscard]] std::optional<Hit> closest_hit(const Ray& ray) {
    ++counts.rays;
    return timed([&] { return accel_.closest_hit(ray); });
  }

  [[nodiscard]] bool occluded(const Ray& ray) {
    ++counts.rays;
    return timed([&] { return accel_.occluded(ray); });
  }

  void closest_hits(const RayWave& rays, std::size_t count, HitWave& hits) {
    counts.rays += count;
    timed([&] { accel_.closest_hits(rays, count, Coherence::none, hits); });
  }

  /// Of camera rays: a row of neighbours in the first `width` lanes of each of `rows` steps.
  void camera_hits(const RayWave& rays, std::size_t rows, std::size_t width, HitWave& hits) {
    counts.rays += rows * width;
    timed([&] { accel_.closest_hits(rays, rows * kWaveStep, Coherence::steps, hits); });
  }

  void occluded_rays(const RayWave& rays, std::size_t count, Wave<std::uint8_t>& blocked) {
    counts.rays += count;
    timed([&] { accel_.occluded_rays(rays, count, blocked); });
  }

  class Timing {
   public:
    Timing(Tracer& tracer, bool on) : tracer_(tracer), start_(__rdtsc()) { tracer_.timing_ = on; }
    ~Timing() {
      if (tracer_.timing_) tracer_.counts.timed_ticks += __rdtsc() - start_;
      tracer_.timing_ = false;
    }
    Timing(const Timing&) = delete;
    Timing& operator=(const Timing&) = delete;

   private:
    Tracer& tracer_;
    std::uint64_t start_;
  };

  TraceCounts counts;
  LightQuery light_query;  // of the vertex at which a path is; kept here for its memory

 private:
  struct Stopwatch {
    explicit Stopwatch(std::uint64_t& to) : sum(to), start(__rdtsc()) {}
    ~Stopwatch() { sum += __rdtsc() - start; }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    std::uint64_t& sum;
    std::uint64_t start;
  };

  template <class Query>
  std::invoke_result_t<Query> timed(const Query& query) {
    if (!timing_) return query();
    const Stopwatch stopwatch(counts.traversal_ticks);
    return query();
  }

  const Accelerator& accel_;
  bool timing_ = false;
};

}  // namespace lemma
