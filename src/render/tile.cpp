#include "src/render/tile.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "src/render/camera_rays.h"

namespace lemma {
namespace {

constexpr int kTileSize = 16;
static_assert(kTileSize <= PixelBlock::kSize);
constexpr std::uint32_t kTimedSampleStride = 64;  // one sample of a row in so many is timed

bool is_radiance(const Rgb& c) {
  constexpr float most = std::numeric_limits<float>::max();
  return c.r >= 0 && c.r <= most && c.g >= 0 && c.g <= most && c.b >= 0 && c.b <= most;  // no NaN is
}

/// Renders the samples of one row of a tile: one sample of every pixel at a time, so that the camera rays can
/// be traced together.
class TileRow {
 public:
  TileRow(const Camera& camera, const RenderSettings& settings, const Tile& tile, int y, Film& film)
      : tile_(tile),
        y_(y),
        film_(film),
        camera_rays_(camera, settings, tile.x, y, static_cast<std::size_t>(tile.width)) {}

  void render_sample(std::uint32_t sample, const World& world, const Integrator& integrator, Tracer& tracer,
                     TileResult& result) {
    const auto count = static_cast<std::size_t>(tile_.width);
    std::array<Ray, kTileSize> rays;
    std::array<std::optional<Hit>, kTileSize> hits;
    camera_rays_.aim(sample, {rays.data(), count});
    tracer.closest_hits({rays.data(), count}, {hits.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      const int x = tile_.x + static_cast<int>(i);
      Sampler random = camera_rays_.random(i);
      const Rgb value = integrator.radiance(rays[i], hits[i], world, tracer, random);
      film_.prepare(x, y_, sample);
      if (is_radiance(value)) {
        film_.add(x, y_, sample, value);
      } else {
        report_invalid({x, y_, sample, value}, result);
      }
    }
  }

 private:
  static void report_invalid(const InvalidSample& invalid, TileResult& result) {
    ++result.invalid_samples;
    if (result.first_invalid.size() < RenderResult::kReportedInvalid) result.first_invalid.push_back(invalid);
  }

  const Tile& tile_;
  int y_;
  Film& film_;
  CameraRays camera_rays_;
};

}  // namespace

std::vector<Tile> tiles_of(int width, int height) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += kTileSize) {
    for (int x = 0; x < width; x += kTileSize) {
      tiles.push_back({x, y, std::min(kTileSize, width - x), std::min(kTileSize, height - y)});
    }
  }
  return tiles;
}

TileResult render_tile(const World& world, const Integrator& integrator, const Camera& camera,
                       const RenderSettings& settings, const Tile& tile, const SampleRange& samples,
                       Film& film) {
  TileResult result;
  Tracer tracer(world.accel);
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    TileRow row(camera, settings, tile, y, film);
    for (std::uint32_t sample = samples.begin; sample < samples.end; ++sample) {
      // Rows start at different samples, so that an image of few samples is timed as well.
      const bool timed = (sample + static_cast<std::uint32_t>(y)) % kTimedSampleStride == 0;
      const Tracer::Timing timing(tracer, timed);
      row.render_sample(sample, world, integrator, tracer, result);
    }
  }
  result.counts = tracer.counts;
  return result;
}

}  // namespace lemma
