#include "src/render/render.h"

#include <algorithm>
#include <atomic>
#include <chrono>
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

RenderResult render(const World& world, const Integrator& integrator, const RenderSettings& settings,
                    const ProgressSink& progress) {
  const auto start = std::chrono::steady_clock::now();
  const Camera camera(world.scene.view);
  const std::vector<Tile> tiles = tiles_of(camera.width(), camera.height());
  RenderResult result;
  const std::size_t pixels =
      static_cast<std::size_t>(camera.width()) * static_cast<std::size_t>(camera.height());
  result.image = {camera.width(), camera.height(), std::vector<Rgb>(pixels)};
  result.camera_samples = std::uint64_t{settings.spp} * pixels;

  std::vector<TileResult> tile_results(tiles.size());
  ThrottledProgress throttled(progress, tiles.size());
  parallel_for(tiles.size(), [&](std::size_t i) {
    tile_results[i] = render_tile(world, integrator, camera, settings, tiles[i], result.image);
    throttled.tile_done();
  });
  collect(tile_results, result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace lemma
