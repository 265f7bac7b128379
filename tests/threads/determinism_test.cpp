#include <gtest/gtest.h>

#include "src/core/parallel.h"
#include "tests/support/images.h"

namespace lemma {
namespace {

/// The image is a function of scene, options and seed: not of the number of threads, nor of which of them did
/// what.
TEST(Determinism, SameBitsWithAnyNumberOfThreads) {
  for (const char* name : {"veach-mis", "cornell-coplanar"}) {
    const Scene scene = test::own_scene(name, 100, 60);
    for (const char* accel : {"embree", "grid"}) {
      RenderResult first;
      for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        RenderResult result = test::render_scene(scene, {accel}, {.spp = 4, .seed = 5});
        if (threads == 1) {
          first = std::move(result);
          continue;
        }
        EXPECT_EQ(test::differing_pixels(first.image, result.image), 0u)
            << name << " " << accel << " " << threads;
        EXPECT_EQ(first.counts.rays, result.counts.rays);
      }
    }
  }
}

TEST(Determinism, TheSeedMatters) {
  const Scene scene = test::own_scene("cornell-box", 16, 16);
  const auto a = test::render_scene(scene, {}, {.spp = 1, .seed = 1}),
             b = test::render_scene(scene, {}, {.spp = 1, .seed = 2});
  EXPECT_GT(test::differing_pixels(a.image, b.image), 0u);
}

}  // namespace
}  // namespace lemma
