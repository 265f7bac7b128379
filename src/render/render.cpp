#include "src/render/render.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <mutex>
#include <tuple>

#include "src/core/parallel.h"
#include "src/render/tile.h"

namespace lemma {
namespace {

/// Passes the number of finished tiles on to a sink, to one thread at a time and not more than ten times a
/// second.
class ThrottledProgress {
 public:
  ThrottledProgress(const ProgressSink& sink, std::size_t tiles) : sink_(sink), tiles_(tiles) {}

  void tile_done() {
    const std::size_t done = ++done_;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || !sink_) return;
    const auto now = std::chrono::steady_clock::now();
    if (done < tiles_ && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    sink_(static_cast<double>(done) / static_cast<double>(tiles_));
  }

 private:
  const ProgressSink& sink_;
  std::size_t tiles_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Of all threads of the program.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void collect(const std::vector<TileResult>& tiles, RenderResult& result) {
  for (const TileResult& tile : tiles) {
    result.counts += tile.counts;
    result.invalid_samples += tile.invalid_samples;
    result.first_invalid.insert(result.first_invalid.end(), tile.first_invalid.begin(),
                                tile.first_invalid.end());
  }
  std::ranges::sort(result.first_invalid, {},
                    [](const InvalidSample& i) { return std::tuple(i.y, i.x, i.sample); });
  if (result.first_invalid.size() > RenderResult::kReportedInvalid) {
    result.first_invalid.resize(RenderResult::kReportedInvalid);
  }
}

}  // namespace

Rendering::Rendering(const World& world, const Integrator& integrator, const RenderSettings& settings)
    : world_(world),
      integrator_(integrator),
      settings_(settings),
      camera_(world.scene.view),
      film_(camera_.width(), camera_.height(), settings.film_parts()) {}

void Rendering::render_to(std::uint32_t spp, const ProgressSink& progress) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = processor_seconds();
  const SampleRange samples{counts_.spp, spp};
  const std::vector<Tile> tiles = tiles_of(film_.width(), film_.height());
  std::vector<TileResult> tile_results(tiles.size());
  ThrottledProgress throttled(progress, tiles.size());
  parallel_for(tiles.size(), [&](std::size_t i) {
    tile_results[i] = render_tile(world_, integrator_, camera_, settings_, tiles[i], samples, film_);
    throttled.tile_done();
  });
  collect(tile_results, counts_);
  counts_.spp = spp;
  counts_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  counts_.cpu_seconds += processor_seconds() - cpu_start;
}

RenderResult Rendering::result() const {
  RenderResult result = counts_;
  result.image = film_.image();
  result.variance = film_.variance();
  result.parts = std::min(film_.parts(), std::max(2u, result.spp));
  result.camera_samples = std::uint64_t{result.spp} * result.image.pixels.size();
  return result;
}

RenderResult render(const World& world, const Integrator& integrator, const RenderSettings& settings,
                    const ProgressSink& progress) {
  Rendering rendering(world, integrator, settings);
  rendering.render_to(settings.spp, progress);
  return rendering.result();
}

}  // namespace lemma
