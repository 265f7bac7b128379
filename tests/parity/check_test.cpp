#include "src/parity/check.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "accel/watertight.h"
#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

constexpr std::uint32_t kRays = 4000;

/// Answers as another does, but for what a test spoils.
class Spoiled final : public Accelerator {
 public:
  using Spoil = void (*)(std::optional<Hit>&);
  Spoiled(const Accelerator& sound, Spoil hits, bool blocks) : sound_(sound), spoil_(hits), blocks_(blocks) {}

  std::optional<Hit> closest_hit(const Ray& ray) const override {
    auto hit = sound_.closest_hit(ray);
    spoil_(hit);
    return hit;
  }
  bool occluded(const Ray& ray) const override { return blocks_ || sound_.occluded(ray); }
  std::size_t memory_bytes() const override { return 0; }
  std::string description() const override { return "spoiled"; }

 private:
  const Accelerator& sound_;
  Spoil spoil_;
  bool blocks_;
};

class Parity : public testing::Test {
 protected:
  Tally check(Spoiled::Spoil spoil, bool blocks = false) const {
    const Spoiled spoiled(*grid_, spoil, blocks);
    const Contestant contestant{"spoiled", &spoiled};
    return check_parity(oracle_, source_, {&contestant, 1}, kRays, nullptr).front().total();
  }

  Scene scene_ = test::own_scene("veach-mis", 64, 36);
  std::unique_ptr<const Accelerator> grid_ =
      find_named(accelerators(), std::string_view("grid")).value()(scene_.triangles, {});
  Camera camera_{scene_.view};
  std::unique_ptr<const LightSampler> lights_ = find_named(light_samplers(), std::string_view("solid-angle"))
                                                    .value()(scene_.emitters, scene_.triangles);
  Oracle oracle_{scene_.triangles};
  RaySource source_{{scene_.triangles, grid_.get(), &camera_, lights_.get()}, 7};
};

TEST_F(Parity, TheGridIsNeverWrong) {
  const Tally tally = check([](std::optional<Hit>&) {});
  EXPECT_EQ(tally.rays, kRays);
  EXPECT_EQ(tally.faults(), 0u);
  EXPECT_LT(tally.distance_error, 1);
  EXPECT_GT(tally.decided, kRays / 2);
}

TEST_F(Parity, FaultsAreFound) {
  const Tally missing = check([](std::optional<Hit>& hit) { hit.reset(); });
  EXPECT_GT(missing.missed, kRays / 2);
  EXPECT_EQ(missing.wrong, 0u);
  const Tally other = check([](std::optional<Hit>& hit) {
    if (hit) hit->triangle ^= 1;
  });
  EXPECT_GT(other.wrong, kRays / 2);
  const Tally farther = check([](std::optional<Hit>& hit) {
    if (hit) hit->t *= 1.01f;
  });
  EXPECT_GT(farther.wrong, kRays / 3);
  const Tally blocking = check([](std::optional<Hit>&) {}, true);
  EXPECT_GT(blocking.wrong_occlusion, 10u);
  EXPECT_EQ(blocking.wrong + blocking.missed, 0u);
}

TEST_F(Parity, EveryKindIsDrawnInItsShare) {
  std::array<std::uint32_t, kRayKinds> count{};
  for (std::uint32_t i = 0; i < 20; ++i) ++count[static_cast<std::size_t>(kind_of(i))];
  EXPECT_EQ(count, (std::array<std::uint32_t, kRayKinds>{4, 4, 4, 1, 1, 1, 1, 1, 1, 1, 1}));
}

TEST_F(Parity, RaysDependOnSeedAndIndexAlone) {
  const RaySource other({scene_.triangles, grid_.get(), &camera_, lights_.get()}, 8);
  int different = 0;
  for (const std::uint32_t i : {39u, 3u, 7u, 11u, 12u, 15u, 19u, 0u}) {
    const Ray a = source_.draw(i), b = source_.draw(i), c = other.draw(i);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof(Ray)), 0) << i;
    different += std::memcmp(&a, &c, sizeof(Ray)) != 0 ? 1 : 0;
  }
  EXPECT_GE(different, 7);
}

TEST_F(Parity, AStrideLeavesRaysOutOfEveryKindAlike) {
  const Contestant contestant{"grid", grid_.get(), 4};
  const Record record = check_parity(oracle_, source_, {&contestant, 1}, kRays, nullptr).front();
  EXPECT_EQ(record.total().rays, kRays / 4);
  for (std::size_t k = 0; k < kRayKinds; ++k) EXPECT_EQ(record.kinds[k].rays, kRays / 80 * (k < 3 ? 4 : 1));
}

/// A hit that another test has found beside the triangle by a rounding error keeps a t of the triangle,
/// though the plane, seen edge-on there, is far away.
TEST(HitOn, StaysOnTheTriangle) {
  const Triangle triangle{{0, 0, 1}, {1, 0, 2}, {0.5f, 1e-6f, 1.5f}};
  for (const float beside : {-1e-7f, 1e-7f, 2e-6f}) {
    const Hit hit = hit_on(ShearedRay({{0.5f, beside, 0}, {1e-3f, -1e-7f, 1}}), triangle, 0);
    EXPECT_GE(hit.t, 1) << beside;
    EXPECT_LE(hit.t, 2) << beside;
  }
}

/// A bare mesh has neither camera nor lights.
TEST(ParityOfMeshes, BackendsAreNeverWrong) {
  const auto mesh = test::sphere_mesh({3, 1, -2}, 0.5f, 30, 60);
  const Oracle oracle(mesh);
  for (const std::string_view name : {"grid", "brute"}) {
    const auto accel = find_named(accelerators(), name).value()(mesh, {});
    const Contestant contestant{name, accel.get()};
    const RaySource source({.triangles = mesh, .walker = accel.get()}, 9);
    EXPECT_EQ(check_parity(oracle, source, {&contestant, 1}, kRays, nullptr).front().total().faults(), 0u);
  }
}

/// Of sizes for which the grid's cost model chooses between few cells, of which crowded ones are grids again,
/// and many.
TEST(ParityOfMeshes, GridsOfOneAndOfTwoLevelsAreNeverWrong) {
  const auto sphere = test::sphere_mesh({0.3f, 0.1f, -0.2f}, 0.1f, 300, 450);
  auto in_a_box = test::inward_box({-1, -1, -1}, {1, 1, 1});
  in_a_box.insert(in_a_box.end(), sphere.begin(), sphere.end());
  for (const auto& [mesh, has_levels] : {std::pair(in_a_box, true), std::pair(sphere, false)}) {
    const auto grid = find_named(accelerators(), std::string_view("grid")).value()(mesh, {});
    EXPECT_EQ(grid->description().find(" 0 of them grids") == std::string::npos, has_levels);
    const Contestant contestant{"grid", grid.get()};
    const RaySource source({.triangles = mesh, .walker = grid.get()}, 9);
    EXPECT_EQ(check_parity(Oracle(mesh), source, {&contestant, 1}, kRays, nullptr).front().total().faults(),
              0u);
  }
}

}  // namespace
}  // namespace lemma
