#pragma once

#include <functional>
#include <vector>

#include "integrators/integrator.h"
#include "src/render/film.h"

namespace lemma {

struct RenderSettings {
  std::uint32_t spp = 16;  // samples a pixel, of render(); Rendering is told how many when it renders
  std::uint64_t seed = 0;
  Sequence sequence = Sequence::sobol;
  std::uint32_t replicates = 1;  // independent scramblings that the samples take turns with

  /// Parts that the film sums the samples in, see Film: independent samples are as many replicates as one
  /// likes, and the more there are, the better is a variance known.
  [[nodiscard]] std::uint32_t film_parts() const {
    return sequence == Sequence::independent ? kIndependentParts : replicates;
  }
  static constexpr std::uint32_t kIndependentParts = 8;

  static constexpr std::uint32_t kMostSamples = 1u << 30;
};

struct RenderResult {
  Image image;
  Image variance;           // see Film::variance()
  std::uint32_t parts = 2;  // of the samples, that `variance` is made from
  std::uint32_t spp = 0;    // samples a pixel
  std::uint64_t camera_samples = 0;
  TraceCounts counts;
  double seconds = 0;                 // wall time of the rendering proper
  double cpu_seconds = 0;             // processor time of the same, all threads
  std::uint64_t invalid_samples = 0;  // left out of the image
  std::vector<InvalidSample>
      first_invalid;  // some of them, the same whatever the threads; in order of pixels

  static constexpr std::size_t kReportedInvalid = 16;
};

/// Called now and then from any thread with the part done, in [0, 1]; never from two threads at a time.
using ProgressSink = std::function<void(double)>;

/// A rendering of the scene as its camera sees it, on all threads (src/core/parallel.h), to which samples can
/// be added. The image is a function of world, integrator, settings and number of samples alone: each pixel's
/// samples are drawn by their own numbers and summed in order by one task at a time.
class Rendering {
 public:
  /// Keeps references to world and integrator.
  Rendering(const World& world, const Integrator& integrator, const RenderSettings& settings);

  /// Renders the samples that lack until each pixel has `spp`.
  void render_to(std::uint32_t spp, const ProgressSink& progress);

  [[nodiscard]] std::uint32_t spp() const { return counts_.spp; }
  [[nodiscard]] double seconds() const { return counts_.seconds; }  // see RenderResult
  [[nodiscard]] RenderResult result() const;

 private:
  const World world_;
  const Integrator& integrator_;
  RenderSettings settings_;
  Camera camera_;
  Film film_;
  RenderResult counts_;  // without the image
};

/// All samples at once.
[[nodiscard]] RenderResult render(const World& world, const Integrator& integrator,
                                  const RenderSettings& settings, const ProgressSink& progress);

}  // namespace lemma
