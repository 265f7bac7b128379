#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "src/shading/phong.h"
#include "tests/support/brdfs.h"
#include "tests/support/hemisphere.h"

namespace lemma {
namespace {

using test::direction;
using test::lobe_alone;
using test::mirror;
using test::mixed;

class EverySampling : public testing::TestWithParam<BrdfOptions> {};
INSTANTIATE_TEST_SUITE_P(Brdf, EverySampling, testing::ValuesIn(test::kSamplings));

/// The density is the inverse of the area that the unit square of numbers is stretched to. Central
/// differences over h err by h^2 of the third derivative, and by the float rounding of directions, 2^-23,
/// over the step of the directions: h times the lobe's width, (n + 1)^(-1/2).
TEST_P(EverySampling, DensityIsTheInverseJacobian) {
  int checked = 0;
  for (const float n : {0.0f, 1.0f, 20.0f, 100.0f, 1e3f, 1e4f}) {
    const Material material = lobe_alone(n, GetParam());
    const Phong<true> brdf(material);
    const float h = n > 100 ? 1.0f / 64 : 1.0f / 1024;
    const double tolerance = 4e-3 + 12 * double{h} * double{h} + 0x1p-23 * std::sqrt(n + 1.0) / double{h};
    for (const double angle : {0.0, 50.0, 80.0}) {
      const Vec3 wo = direction(angle);
      for (const float u : {0.2f, 0.5f, 0.8f}) {
        for (const float v : {0.15f, 0.4f, 0.7f, 0.9f}) {
          const auto at = [&](float a, float b) { return brdf.sample(wo, 0.5f, {a, b}); };
          const auto s = at(u, v), left = at(u - h, v), right = at(u + h, v), down = at(u, v - h),
                     up = at(u, v + h);
          if (!s || !left || !right || !down || !up) continue;
          ++checked;
          const Vec3 along = (right->wi - left->wi) / (2 * h), across = (up->wi - down->wi) / (2 * h);
          EXPECT_NEAR(length(cross(along, across)) * s->pdf.value, 1, tolerance)
              << "n " << n << ", " << angle << " degrees, u " << u << " " << v;
        }
      }
    }
  }
  EXPECT_GT(checked, 150);  // of 216, less what the horizon cuts
}

TEST_P(EverySampling, SamplePdfAndEvalAgree) {
  for (const float n : {0.0f, 1.0f, 100.0f, 1e4f, 1e6f}) {
    const Material material = mixed(n, GetParam());
    const Phong<true> brdf(material);
    Sampler random(12, static_cast<std::uint32_t>(n), 0);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 wo = cosine_hemisphere(random.next_2d());
      const float choice = random.next();
      const auto sample = brdf.sample(wo, choice, random.next_2d());
      if (!sample) continue;
      ASSERT_NEAR(length(sample->wi), 1, 4 * 0x1p-23);
      // The same expressions in another order: a few roundings.
      ASSERT_NEAR(sample->pdf.value / brdf.pdf(wo, sample->wi).value, 1, 1e-5);
      const Rgb expected = brdf.eval(wo, sample->wi) * (sample->wi.z / sample->pdf.value);
      ASSERT_NEAR(sample->weight.g, expected.g, 1e-5f * expected.g + 1e-12f);
    }
  }
}

/// With sharp exponents the mean of 1 - cos(alpha) over samples of cos^n is 1 / (n + 2): about the mirror
/// direction, or of the half vector about the normal.
TEST_P(EverySampling, NarrowLobesAreSampledWithTheRightWidth) {
  const bool half = GetParam().lobe == Lobe::blinn_phong;
  for (const float n : {1e3f, 1e4f, 1e5f, 1e6f}) {
    const Material material = lobe_alone(n, GetParam());
    const Vec3 wo = direction(30);
    constexpr int draws = 100000;
    double sum = 0;
    Sampler random(14, static_cast<std::uint32_t>(n), 0);
    for (int i = 0; i < draws; ++i) {
      const auto sample = Phong<true>(material).sample(wo, 0.5f, random.next_2d());
      ASSERT_TRUE(sample);
      const Vec3d w(half ? normalize(Vec3d(wo) + Vec3d(sample->wi)) : Vec3d(sample->wi));
      const Vec3d d = w - (half ? Vec3d(0, 0, 1) : Vec3d(mirror(wo)));
      sum += 0.5 * dot(d, d);
    }
    // The relative standard deviation of one value is about 1; roundings of unit vectors, 6e-8, shift d^2 / 2
    // by 1e-14 and are 1e-8 of it at n = 1e6.
    EXPECT_NEAR(sum / draws * (n + 2), 1, 5 / std::sqrt(draws)) << n;
  }
}

TEST_P(EverySampling, ExtremeNumbersGiveFiniteSamples) {
  constexpr float last = 1 - 0x1p-24f;
  for (const float n : {0.0f, 1.0f, 5000.0f, 1e6f}) {
    for (const Material& material : {mixed(n, GetParam()), lobe_alone(n, GetParam())}) {
      for (const float choice : {0.0f, last}) {
        for (const Vec2& u : {Vec2(0, 0), Vec2(last, 0), Vec2(0, last), Vec2(last, last), Vec2(0.5f, 0.5f)}) {
          for (const double angle : {0.0, 45.0, 89.99, 89.99999}) {
            const Vec3 wo = direction(angle);
            const auto sample = Phong<true>(material).sample(wo, choice, u);
            if (!sample) continue;
            EXPECT_TRUE(is_finite(sample->wi));
            EXPECT_NEAR(length(sample->wi), 1, 4 * 0x1p-23);
            EXPECT_TRUE(std::isfinite(sample->pdf.value) && sample->pdf.value > 0);
            EXPECT_TRUE(std::isfinite(sample->weight.g) && sample->weight.g >= 0);
          }
        }
      }
    }
  }
}

/// Directions that no sample takes, but a light sample may: both along the surface, opposed and alike.
TEST_P(EverySampling, ValuesOfGrazingDirectionsAreFinite) {
  for (const float n : {0.0f, 1.0f, 1e6f}) {
    const Material material = mixed(n, GetParam());
    for (const float z : {1e-30f, 1e-20f, 1e-8f}) {
      for (const Vec3& wi : {Vec3(1, 0, z), Vec3(-1, 0, z), Vec3(-1.0000001f, 0, z)}) {
        const Vec3 wo(1, 0, z);
        EXPECT_TRUE(std::isfinite(Phong<true>(material).eval(wo, wi).g));
        EXPECT_TRUE(std::isfinite(Phong<true>(material).pdf(wo, wi).value));
        EXPECT_GE(Phong<true>(material).pdf(wo, wi).value, 0);
      }
    }
  }
}

/// The truncated lobe loses no sample, and no weight is larger than that of p6.
TEST(TruncatedLobe, WastesNoSampleAndNeverVariesMore) {
  constexpr int draws = 50000;
  for (const float n : {0.0f, 1.0f, 5.0f, 20.0f, 100.0f}) {
    for (const double angle : {0.0, 60.0, 75.0, 89.0}) {
      struct Weights {
        double mean = 0, square = 0;
        int lost = 0;
        [[nodiscard]] double variance() const { return square - mean * mean; }
      };
      std::map<LobeSampling, Weights> weights;
      for (const auto& [name, sampling, help] : lobe_samplings()) {
        const Material material = lobe_alone(n, {.sampling = sampling});
        Weights& w = weights[sampling];
        Sampler random(15, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(angle));
        for (int i = 0; i < draws; ++i) {
          const auto sample = Phong<true>(material).sample(direction(angle), 0.5f, random.next_2d());
          if (!sample) ++w.lost;
          const double weight = sample ? double{sample->weight.g} : 0.0;
          w.mean += weight / draws, w.square += weight * weight / draws;
        }
      }
      const Weights &truncated = weights[LobeSampling::truncated], &p6 = weights[LobeSampling::p6];
      std::printf("n %5g, %2g degrees: lost %5.1f %% of p6, %.2g %% of truncated; variance %.4f, %.4f\n",
                  double{n}, angle, 100.0 * p6.lost / draws, 100.0 * truncated.lost / draws, p6.variance(),
                  truncated.variance());
      EXPECT_LE(truncated.lost, draws / 10000);  // rounding at the horizon
      // Where no direction is cut they differ by the noise of a variance, sqrt(2 / draws) of it and more
      // where weights are skewed.
      EXPECT_LE(truncated.variance(), p6.variance() * 1.05 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace lemma
