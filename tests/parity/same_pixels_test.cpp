#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <cstring>

#include "src/oracle/oracle.h"
#include "src/render/tile.h"
#include "tests/support/images.h"
#include "tests/support/real_scenes.h"

namespace lemma {
namespace {

/// Answers as the first accelerator does, and has the oracle class the rays that the second sees otherwise:
/// all rays, one by one, or those of a column in packets of camera rays, which may be seen otherwise again.
class Comparison final : public Accelerator {
 public:
  Comparison(const Accelerator& a, const Accelerator& b, const Oracle& oracle,
             std::optional<std::size_t> column = std::nullopt)
      : a_(a), b_(b), oracle_(oracle), column_(column) {}

  std::optional<Hit> closest_hit(const Ray& ray) const override {
    const auto hit = a_.closest_hit(ray);
    if (!column_ && hit != b_.closest_hit(ray)) count(ray);
    return hit;
  }
  bool occluded(const Ray& ray) const override {
    const bool blocked = a_.occluded(ray);
    if (!column_ && blocked != b_.occluded(ray)) count(ray);
    return blocked;
  }
  void closest_hits(const RayWave& rays, std::size_t count, Coherence coherence,
                    HitWave& hits) const override {
    if (!column_ || coherence == Coherence::none)
      return Accelerator::closest_hits(rays, count, coherence, hits);
    HitWave others;
    a_.closest_hits(rays, count, coherence, hits);
    b_.closest_hits(rays, count, coherence, others);
    const bool differ = hits.is_hit(*column_) != others.is_hit(*column_) ||
                        (hits.is_hit(*column_) && hits[*column_] != others[*column_]);
    if (differ) this->count(rays[*column_]);
  }
  std::size_t memory_bytes() const override { return 0; }
  std::string description() const override { return "comparison"; }

  [[nodiscard]] int differing() const { return differing_; }
  [[nodiscard]] int decided() const { return decided_; }

 private:
  void count(const Ray& ray) const {
    ++differing_;
    if (!oracle_.expect(ray).doubt) ++decided_;
  }

  const Accelerator &a_, &b_;
  const Oracle& oracle_;
  std::optional<std::size_t> column_;
  mutable std::atomic<int> differing_{0}, decided_{0};  // rays seen differently; of these the decided ones
};

std::unique_ptr<const Accelerator> make(std::string_view name, const Scene& scene) {
  return find_named(accelerators(), name).value()(scene.triangles, {});
}

/// Renders with grid and Embree. Where a pixel differs in any bit its paths are traced again, alone and then
/// beside those whose camera rays share its packets: they must hold a ray that the two see differently, and
/// the oracle must call every such ray ambiguous.
void expect_differences_explained(const Scene& scene, std::string_view name) {
  const auto grid = make("grid", scene), embree = make("embree", scene);
  const auto lights = light_samplers().front().value(scene.emitters, scene.triangles);
  const auto integrator = integrators().front().value(scene.needs.model, {});
  const Oracle oracle(scene.triangles);
  const Camera camera(scene.view);
  const RenderSettings settings{.spp = 64, .seed = 91};
  const Image a = render({scene, *grid, *lights}, *integrator, settings, nullptr).image;
  const Image b = render({scene, *embree, *lights}, *integrator, settings, nullptr).image;
  EXPECT_GT(test::image_mean(a), 0) << "a black picture shows nothing";
  const auto trace_again = [&](const Comparison& both, const Tile& tile) {
    Film again(a.width, a.height, 1);
    (void)render_tile({scene, both, *lights}, *integrator, camera, settings, tile, {0, settings.spp}, again);
  };
  int pixels = 0;
  for (const Tile& tile : tiles_of(a.width, a.height)) {
    for (int i = 0; i < tile.width * tile.height; ++i) {
      const int column = i % tile.width, x = tile.x + column, y = tile.y + i / tile.width;
      if (std::memcmp(&a.at(x, y), &b.at(x, y), sizeof(Rgb)) == 0) continue;
      ++pixels;
      const Comparison alone(*grid, *embree, oracle);
      trace_again(alone, {x, y, 1, 1});
      const Comparison in_packets(*grid, *embree, oracle, static_cast<std::size_t>(column));
      trace_again(in_packets, {tile.x, y, tile.width, 1});
      EXPECT_GT(alone.differing() + in_packets.differing(), 0) << name << ": pixel " << x << "," << y;
      EXPECT_EQ(alone.decided() + in_packets.decided(), 0) << name << ": pixel " << x << "," << y;
    }
  }
  std::printf("%.*s: %d of %zu pixels differ, each by ambiguous rays\n", static_cast<int>(name.size()),
              name.data(), pixels, a.pixels.size());
}

TEST(SamePixels, OnOwnScenes) {
  for (const char* name : {"veach-mis", "cornell-box", "cornell-coplanar"}) {
    expect_differences_explained(test::own_scene(name, 96, 54), name);
  }
}

TEST(SamePixels, OnTheStaircase) {
  const auto folder = test::real_scenes();
  if (!folder) GTEST_SKIP() << test::kNoRealScenes;
  Scene scene = load_scene(*folder / "zju-2022-staircase").scene;
  scene.view.width = 96, scene.view.height = 54;
  expect_differences_explained(scene, "staircase");
}

}  // namespace
}  // namespace lemma
