#include "src/render/tile.h"

#include <algorithm>
#include <limits>

#include "src/render/camera_rays.h"

namespace lemma {
namespace {

constexpr int kTileSize = 16;
static_assert(kTileSize <= PixelBlock::kSize && kTileSize <= kWaveStep && kTileSize * kWaveStep <= kWaveSize);
constexpr std::uint32_t kTimedSampleStride = 64;  // one sample of a tile in so many is timed

bool is_radiance(const Rgb& c) {
  constexpr float most = std::numeric_limits<float>::max();
  return c.r >= 0 && c.r <= most && c.g >= 0 && c.g <= most && c.b >= 0 && c.b <= most;  // no NaN is
}

/// Renders the samples of a tile: one sample of every pixel at a time, as a wave.
class TileSamples {
 public:
  TileSamples(const World& world, const Integrator& integrator, const Camera& camera,
              const RenderSettings& settings, const Tile& tile, Film& film)
      : tile_(tile),
        width_(static_cast<std::size_t>(tile.width)),
        film_(film),
        waves_(integrator.waves(world)),
        tracer_(world.accel) {
    for (std::size_t row = 0; row < static_cast<std::size_t>(tile.height); ++row) {
      rows_.emplace_back(camera, settings, tile.x, tile.y + static_cast<int>(row), width_, lane_of(row));
      for (std::size_t i = 0; i < kWaveStep; ++i) {
        const float t_max = i < width_ ? std::numeric_limits<float>::infinity() : 0;  // no ray
        rays_.set(lane_of(row) + i, {camera.eye(), Vec3(0), 0, t_max});
      }
    }
  }

  void render(std::uint32_t sample) {
    // Tiles start at different samples, so that an image of few samples is timed as well.
    const bool timed =
        (sample + static_cast<std::uint32_t>(tile_.x + tile_.y) / kTileSize) % kTimedSampleStride == 0;
    const Tracer::Timing timing(tracer_, timed);
    for (CameraRays& row : rows_) row.aim(sample, rays_.direction, random_);
    tracer_.camera_hits(rays_, rows_.size(), width_, hits_);
    waves_->radiances(rays_, hits_, lane_of(rows_.size()), tracer_, random_, radiance_);
    for (std::size_t row = 0; row < rows_.size(); ++row) add(row, sample);
  }

  [[nodiscard]] TileResult result() {
    result_.counts = tracer_.counts;
    return std::move(result_);
  }

 private:
  /// A row of pixels is a step of the wave, of which a narrow tile leaves the last lanes without rays: those
  /// of a row are traced together, which is fast, as they start at one point and are neighbours.
  static std::size_t lane_of(std::size_t row) { return row * kWaveStep; }

  void add(std::size_t row, std::uint32_t sample) {
    const int y = tile_.y + static_cast<int>(row);
    Film::Run pixels = film_.run(tile_.x, y, width_, sample);
    for (std::size_t i = 0; i < width_; ++i) {
      const Rgb value = radiance_[lane_of(row) + i];
      if (is_radiance(value)) {
        pixels.add(i, value);
      } else {
        report_invalid({tile_.x + static_cast<int>(i), y, sample, value});
      }
    }
  }

  void report_invalid(const InvalidSample& invalid) {
    ++result_.invalid_samples;
    if (result_.first_invalid.size() < RenderResult::kReportedInvalid)
      result_.first_invalid.push_back(invalid);
  }

  const Tile& tile_;
  const std::size_t width_;
  Film& film_;
  std::unique_ptr<WaveIntegrator> waves_;
  Tracer tracer_;
  std::vector<CameraRays> rows_;
  SamplerWave random_;
  RayWave rays_;
  HitWave hits_;
  RgbWave radiance_;
  TileResult result_;
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
  TileSamples tile_samples(world, integrator, camera, settings, tile, film);
  for (std::uint32_t sample = samples.begin; sample < samples.end; ++sample) tile_samples.render(sample);
  return tile_samples.result();
}

}  // namespace lemma
