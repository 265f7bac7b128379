#include "src/render/explain.h"

#include "src/render/tile.h"

namespace lemma {
namespace {

/// Follows the path of one lane of a wave, and none of the others.
class OneLane final : public WaveIntegrator {
 public:
  OneLane(const Integrator& integrator, const World& world, std::size_t lane)
      : integrator_(integrator), world_(world), lane_(lane) {}

  void radiances(const RayWave& rays, const HitWave& first, std::size_t count, Tracer& tracer,
                 const SamplerWave& random, RgbWave& radiance) override {
    for (std::size_t i = 0; i < count; ++i) radiance.set(i, {});
    const std::optional<Hit> hit = first.is_hit(lane_) ? std::optional(first[lane_]) : std::nullopt;
    Sampler of_lane = random[lane_];
    radiance.set(lane_, integrator_.radiance(rays[lane_], hit, world_, tracer, of_lane));
  }

 private:
  const Integrator& integrator_;
  const World world_;
  std::size_t lane_;
};

/// In place of an integrator, explains the paths of one lane and leaves out all others.
class ExplainingIntegrator final : public Integrator {
 public:
  ExplainingIntegrator(const Integrator& integrator, std::size_t lane, PathRecorder::Strategies strategies,
                       const ExplainSink& sink)
      : integrator_(integrator), lane_(lane), strategies_(strategies), sink_(sink) {}

  Rgb radiance(const Ray& ray, const std::optional<Hit>& first, const World& world, Tracer& tracer,
               Sampler& random) const override {
    PathRecorder recorder(world.scene, strategies_);
    const Rgb radiance = integrator_.explain(ray, first, world, tracer, random, recorder);
    sink_({samples_++, ray, recorder.take_events(), radiance});
    return radiance;
  }

  std::unique_ptr<WaveIntegrator> waves(const World& world) const override {
    return std::make_unique<OneLane>(*this, world, lane_);
  }

 private:
  const Integrator& integrator_;
  std::size_t lane_;
  PathRecorder::Strategies strategies_;
  const ExplainSink& sink_;
  mutable std::uint32_t samples_ = 0;  // those of a pixel come in order, on one thread
};

/// The row of a tile that holds the pixel: its camera rays are traced together, and must be here as well,
/// since at an edge a ray by itself may find another triangle.
Tile row_with(const Camera& camera, int x, int y) {
  for (const Tile& tile : tiles_of(camera.width(), camera.height())) {
    const bool inside = x >= tile.x && x < tile.x + tile.width && y >= tile.y && y < tile.y + tile.height;
    if (inside) return {tile.x, y, tile.width, 1};
  }
  return {};
}

}  // namespace

ExplainedPixel explain_pixel(const World& world, const Integrator& integrator, const RenderSettings& settings,
                             int x, int y, PathRecorder::Strategies strategies, const ExplainSink& sink) {
  const Camera camera(world.scene.view);
  const Tile row = row_with(camera, x, y);
  const ExplainingIntegrator explaining(integrator, static_cast<std::size_t>(x - row.x), strategies, sink);
  Film film(camera.width(), camera.height(), settings.film_parts());
  const TileResult result = render_tile(world, explaining, camera, settings, row, {0, settings.spp}, film);
  return {film.image().at(x, y), result.invalid_samples};
}

}  // namespace lemma
