#include "integrators/path_wave.h"

#include <gtest/gtest.h>

#include <cstring>

#include "src/scene/camera.h"
#include "tests/support/images.h"
#include "tests/support/light_scenes.h"
#include "tests/support/real_scenes.h"
#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

/// What follows the paths of a scene, in waves and one by one.
struct Followed {
  RgbWave radiance;
  TraceCounts counts;
};

constexpr std::size_t kPaths = 250;  // no multiple of a register's lanes

/// Camera rays to places all over the image.
class Paths {
 public:
  Paths(const Scene& scene, const Accelerator& accel, Sequence sequence) {
    const Camera camera(scene.view);
    const auto width = static_cast<float>(camera.width()), height = static_cast<float>(camera.height());
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      random_.emplace_back(11, i, 5, sequence, 1);
      const Vec2 u = random_.back().next_2d();
      rays_.set(i, camera.ray_through(u.x * width, u.y * height));
    }
    accel.closest_hits(rays_, kPaths, Coherence::none, hits_);
  }

  [[nodiscard]] Followed in_waves(const Integrator& integrator, const World& world) const {
    Followed followed;
    Tracer tracer(world.accel);
    SamplerWave random;
    for (std::size_t i = 0; i < kPaths; ++i) random.set(i, random_[i]);
    const auto waves = integrator.waves(world);
    for (int k = 0; k < 2; ++k) {  // the second time the memory holds what the first left
      tracer.counts = {};
      waves->radiances(rays_, hits_, kPaths, tracer, random, followed.radiance);
    }
    followed.counts = tracer.counts;
    return followed;
  }

  [[nodiscard]] Followed one_by_one(const Integrator& integrator, const World& world) const {
    Followed followed;
    Tracer tracer(world.accel);
    std::vector<Sampler> random = random_;
    for (std::size_t i = 0; i < kPaths; ++i) {
      const std::optional<Hit> hit = hits_.is_hit(i) ? std::optional(hits_[i]) : std::nullopt;
      followed.radiance.set(i, integrator.radiance(rays_[i], hit, world, tracer, random[i]));
    }
    followed.counts = tracer.counts;
    return followed;
  }

 private:
  RayWave rays_;
  HitWave hits_;
  std::vector<Sampler> random_;
};

/// Every technique and light sampling: the same radiance in every lane, bit for bit, with as many rays. The
/// grid answers waves ray by ray, so that nothing depends on which rays are traced together.
void expect_waves_of_single_paths(const Scene& scene, const IntegratorOptions& options, Sequence sequence) {
  const auto accel = find_named(accelerators(), "grid").value()(scene.triangles, {});
  const Paths paths(scene, *accel, sequence);
  int lit = 0;
  for (const char* name : {"mis", "direct", "brdf"}) {
    const auto integrator = find_named(integrators(), name).value()(scene.needs.model, options);
    for (const auto& strategy : light_samplers()) {
      SCOPED_TRACE(std::string(name) + " " + std::string(strategy.name));
      const auto lights = strategy.value(scene.emitters, scene.triangles);
      const World world{scene, *accel, *lights};
      const Followed waves = paths.in_waves(*integrator, world),
                     single = paths.one_by_one(*integrator, world);
      for (std::size_t i = 0; i < kPaths; ++i) {
        const Rgb a = waves.radiance[i], b = single.radiance[i];
        ASSERT_EQ(std::memcmp(&a, &b, sizeof(Rgb)), 0) << "path " << i << ": " << a.r << ", " << b.r;
        lit += is_black(a) ? 0 : 1;
      }
      ASSERT_EQ(waves.counts.rays, single.counts.rays);
      ASSERT_EQ(waves.counts.paths_cut, single.counts.paths_cut);
    }
  }
  EXPECT_GT(lit, 100);
}

void expect_waves_with_all_options(const Scene& scene) {
  for (const Sequence sequence : {Sequence::sobol, Sequence::independent}) {
    expect_waves_of_single_paths(scene, {}, sequence);
  }
  expect_waves_of_single_paths(scene, {.roulette = Roulette::fixed, .heuristic = Heuristic::balance},
                               Sequence::sobol);
  expect_waves_of_single_paths(scene, {.max_depth = 2, .emitters_reflect = true}, Sequence::sobol);
}

TEST(PathWave, OwnScenesAsSinglePaths) {
  for (const char* name : {"veach-mis", "cornell-box", "cornell-coplanar"}) {
    SCOPED_TRACE(name);
    expect_waves_with_all_options(test::own_scene(name, 32, 18));
  }
}

TEST(PathWave, EveryLobeAsSinglePaths) {
  for (const BrdfOptions& brdf :
       {BrdfOptions{}, BrdfOptions{.lobe = Lobe::blinn_phong}, BrdfOptions{.sampling = LobeSampling::p6}}) {
    expect_waves_of_single_paths(test::glossy_room(brdf), {}, Sequence::sobol);
  }
}

TEST(PathWave, LightsOfAllKindsAsSinglePaths) {
  expect_waves_of_single_paths(test::many_lights(), {}, Sequence::sobol);
  expect_waves_of_single_paths(test::overlapping_lights(), {}, Sequence::sobol);
  expect_waves_of_single_paths(test::light_below_horizon(), {}, Sequence::sobol);
}

/// A box whose light lies in its ceiling, with normals that lean, textures on some of its materials and one
/// of glass, in the given combination.
class ModelTest : public testing::Test {
 protected:
  [[nodiscard]] Scene scene(bool smooth_normals, bool textures, bool glass) const {
    Scene scene = test::own_scene("cornell-coplanar", 32, 18);
    test::double_lights(scene);
    Model& model = scene.needs.model;
    model.smooth_normals = smooth_normals, model.textures = textures, model.glass = glass;
    for (const Triangle& t : scene.triangles) {
      if (smooth_normals) scene.normals.push_back(leaning_normals(t));
      if (textures) scene.texcoords.push_back({Vec2(0, 0), Vec2(3, 0.5f), Vec2(-1, 2)});
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
      if (textures) scene.texture_of.push_back({i % 2 == 0 ? 0 : kNoTexture, {0.9f, 0.8f, 0.7f}});
      if (glass) scene.glass.push_back({i == kGlass ? 4.0f : 1.0f, {0.9f, 1, 1}});
    }
    if (textures) {
      scene.textures.emplace_back(
          folder_.write("a.ppm", "P3\n2 2\n255\n255 0 0  0 255 0\n0 0 255  255 255 255\n"));
    }
    return scene;
  }

 private:
  static constexpr std::size_t kGlass = 0;

  static std::array<Vec3, 3> leaning_normals(const Triangle& t) {
    const Vec3 n = geometric_normal(t);
    return {normalize(n + Vec3(0.3f, 0.1f, 0)), normalize(n + Vec3(0, 0.4f, -0.2f)),
            normalize(n + Vec3(-0.3f, 0, 0.3f))};
  }

  test::SceneFolder folder_;
};

TEST_F(ModelTest, EveryPartAsSinglePaths) {
  for (unsigned parts = 0; parts < 8; ++parts) {
    SCOPED_TRACE(parts);
    expect_waves_with_all_options(scene((parts & 1) != 0, (parts & 2) != 0, (parts & 4) != 0));
  }
}

TEST(PathWave, StaircaseAsSinglePaths) {
  const auto folder = test::real_scenes();
  if (!folder) GTEST_SKIP() << test::kNoRealScenes;
  Scene scene = load_scene(*folder / "zju-2022-staircase").scene;
  expect_waves_of_single_paths(scene, {}, Sequence::sobol);
}

}  // namespace
}  // namespace lemma
