#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/images.h"

namespace lemma {
namespace {

/// At 16 samples a pixel the grid's picture is brute force's, bit for bit. Embree's may differ where a ray
/// passes an edge within rounding or meets two surfaces at one distance; how often is printed.
TEST(ImageParity, GridEqualsBruteForce) {
  for (const char* name : {"veach-mis", "cornell-box", "cornell-coplanar"}) {
    const Scene scene = test::own_scene(name, 96, 54);
    const RenderSettings settings{.spp = 16, .seed = 1};
    const auto brute = test::render_scene(scene, {"brute"}, settings);
    const auto grid = test::render_scene(scene, {"grid"}, settings);
    const auto embree = test::render_scene(scene, {"embree"}, settings);
    EXPECT_EQ(test::differing_pixels(brute.image, grid.image), 0u) << name;
    EXPECT_EQ(brute.invalid_samples + grid.invalid_samples + embree.invalid_samples, 0u) << name;
    std::printf("%s: %zu of %zu pixels differ between grid and embree\n", name,
                test::differing_pixels(grid.image, embree.image), grid.image.pixels.size());
  }
}

}  // namespace
}  // namespace lemma
