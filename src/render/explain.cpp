#include "src/render/explain.h"

#include "src/render/tile.h"

namespace lemma {
namespace {

/// In place of an integrator, explains the paths of one pixel and leaves those of all others out.
class ExplainingIntegrator final : public Integrator {
 public:
  ExplainingIntegrator(const Integrator& integrator, std::uint32_t pixel, PathRecorder::Strategies strategies,
                       const ExplainSink& sink)
      : integrator_(integrator), pixel_(pixel), strategies_(strategies), sink_(sink) {}

  Rgb radiance(const Ray& ray, const std::optional<Hit>& first, const World& world, Tracer& tracer,
               Sampler& random) const override {
    if (random.pixel() != pixel_) return {};
    PathRecorder recorder(world.scene, strategies_);
    const Rgb radiance = integrator_.explain(ray, first, world, tracer, random, recorder);
    sink_({samples_++, ray, recorder.take_events(), radiance});
    return radiance;
  }

 private:
  const Integrator& integrator_;
  std::uint32_t pixel_;
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
  const auto width = static_cast<std::uint32_t>(camera.width());
  const std::uint32_t pixel = static_cast<std::uint32_t>(y) * width + static_cast<std::uint32_t>(x);
  const ExplainingIntegrator explaining(integrator, pixel, strategies, sink);
  Film film(camera.width(), camera.height(), settings.film_parts());
  const TileResult result =
      render_tile(world, explaining, camera, settings, row_with(camera, x, y), {0, settings.spp}, film);
  return {film.image().at(x, y), result.invalid_samples};
}

}  // namespace lemma
