#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "src/shading/phong.h"
#include "tests/support/hemisphere.h"

namespace lemma {
namespace {

using test::direction;

Material grey(float kd, float ks, float exponent, const BrdfOptions& options = {}) {
  return make_material({kd, kd, kd}, {ks, ks, ks}, exponent, options);
}

/// Integral of f cos(theta_i) over the hemisphere. The points lie as the lobe's own directions do, so that
/// what is summed is f / cos^n, which is constant, times the cosine.
double lobe_albedo(const Material& material, const Vec3& wo) {
  const Phong<true> brdf(material);
  const Vec3 mirror(-wo.x, -wo.y, wo.z);
  const double n = material.exponent;
  return test::lobe_mean(mirror, n, [&](const Vec3& wi) {
    if (wi.z <= 0) return 0.0;
    const double x = test::AboutAxis(mirror).one_minus_cos(wi);
    const double density = (n + 1) / (2 * M_PI) * std::pow(1 - x, n);
    return double{brdf.eval(wo, wi).g} * wi.z / density;
  });
}

constexpr std::array<double, 5> kAngles{0, 30, 60, 75, 85};

struct AlbedoRow {
  float n;
  std::array<double, 5> albedo;  // at kAngles
};

/// Directional albedo of the lobe with factor (n + 1) / (2 pi), by numerical quadrature in double, 5 digits.
constexpr AlbedoRow kAlbedo[] = {{1, {.66667, .58723, .40600, .30563, .24206}},
                                 {5, {.85715, .74250, .44521, .28040, .18562}},
                                 {20, {.95455, .82666, .47776, .25885, .13201}},
                                 {100, {.99020, .85754, .49510, .25641, .09666}},
                                 {1000, {.99900, .86516, .49950, .25856, .08710}}};

TEST(Phong, DirectionalAlbedoOfTheLobe) {
  for (const AlbedoRow& row : kAlbedo) {
    for (std::size_t a = 0; a < kAngles.size(); ++a) {
      // Five digits of the table; the midpoint rule's error where the horizon cuts its 600 x 600 cells, which
      // is below 600^-1.5; and roundings of unit vectors, which the exponent multiplies.
      const double tolerance = 1e-5 + 7e-5 * row.albedo[a] + 2 * row.n * 0x1p-24;
      EXPECT_NEAR(lobe_albedo(grey(0, 1, row.n), direction(kAngles[a])), row.albedo[a], tolerance)
          << "n " << row.n << " angle " << kAngles[a];
    }
  }
}

/// The same table from samples: the mean weight is the albedo, whichever directions are drawn.
TEST(Phong, MeanWeightIsTheDirectionalAlbedo) {
  constexpr int draws = 40000;
  for (const auto& sampling : lobe_samplings()) {
    for (const AlbedoRow& row : kAlbedo) {
      for (std::size_t a = 0; a < kAngles.size(); ++a) {
        const Material material = grey(0, 1, row.n, {.sampling = sampling.value});
        Sampler random(10, static_cast<std::uint32_t>(row.n), static_cast<std::uint32_t>(a));
        double sum = 0, squares = 0;
        for (int i = 0; i < draws; ++i) {
          const auto sample = Phong<true>(material).sample(direction(kAngles[a]), 0, random.next_2d());
          const double weight = sample ? double{sample->weight.g} : 0.0;
          sum += weight, squares += weight * weight;
        }
        const double mean = sum / draws, error = std::sqrt((squares / draws - mean * mean) / draws);
        // 50 tests: 4.9 standard errors are exceeded in one of them with probability 5e-5.
        EXPECT_NEAR(mean, row.albedo[a], 4.9 * error + 1e-5)
            << sampling.name << " n " << row.n << " angle " << kAngles[a];
      }
    }
  }
}

TEST(Phong, LargestAlbedoIsThatAtNormalIncidence) {
  for (const float n : {0.0f, 1.0f, 20.0f, 1e6f}) {
    EXPECT_FLOAT_EQ(largest_albedo(grey(0.25f, 0.5f, n)), 0.25f + 0.5f * (n + 1) / (n + 2));
    EXPECT_FLOAT_EQ(largest_albedo(grey(0.25f, 0.5f, n, {.norm = PhongNorm::n_plus_2})), 0.75f);
    EXPECT_FLOAT_EQ(largest_albedo(grey(0.25f, 0.5f, n, {.lobe = Lobe::blinn_phong})), 0.75f);
  }
  EXPECT_EQ(largest_albedo(make_material({0.1f, 0.9f, 0.3f}, {}, 1)), 0.9f);
}

/// Blinn's factor is exact: the albedo of the lobe alone is 1 at normal incidence and no larger elsewhere.
TEST(BlinnPhong, AlbedoIsOneAtNormalIncidenceAndLessElsewhere) {
  for (const float n : {0.0f, 1.0f, 5.0f, 20.0f, 100.0f, 1000.0f}) {
    const double tolerance = 1e-4 + 4 * n * 0x1p-24;  // as above
    EXPECT_NEAR(test::blinn_albedo(n, direction(0)), 1, tolerance) << n;
    for (const double angle : {30.0, 60.0, 75.0, 85.0})
      EXPECT_LT(test::blinn_albedo(n, direction(angle)), 1 + tolerance) << n;
  }
}

/// cos^n keeps its digits: against (1 - x)^n in long double, x from the very directions.
TEST(Phong, SharpLobesKeepTheirDigits) {
  for (const float n : {1.0f, 100.0f, 1e4f, 1e5f, 1e6f}) {
    const Material material = grey(0, 1, n);
    const Vec3 wo = direction(40), mirror(-wo.x, -wo.y, wo.z);
    const test::AboutAxis about(mirror);
    for (int i = 1; i < 100; ++i) {
      const Vec3 wi = about.at(-std::expm1(std::log(i / 100.0) / (n + 1)), i);
      if (wi.z <= 0) continue;
      const long double x = about.one_minus_cos(wi);
      const double expected = static_cast<double>((n + 1) / (2 * M_PI) * std::exp(n * std::log1p(-x)));
      // n x <= 5 is rounded thrice, d^2 / 2 with 6 roundings of |d| * 1e-7 each.
      const double d = std::sqrt(2 * static_cast<double>(x));
      EXPECT_NEAR(Phong<true>(material).eval(wo, wi).g / expected, 1, 32 * 0x1p-24 + n * d * 0x1p-23) << n;
    }
  }
}

TEST(Phong, IsReciprocal) {
  for (const auto& lobe : lobes()) {
    for (const float n : {0.0f, 1.0f, 50.0f, 1000.0f}) {
      const Material material = grey(0.3f, 0.5f, n, {.lobe = lobe.value});
      const Phong<true> brdf(material);
      Sampler random(13, 0, 0);
      for (int i = 0; i < 2000; ++i) {
        const Vec3 a = cosine_hemisphere(random.next_2d()), b = cosine_hemisphere(random.next_2d());
        // The exponent multiplies a rounding of 1 - cos(alpha), of up to eight units.
        ASSERT_NEAR(brdf.eval(a, b).g, brdf.eval(b, a).g, (n + 4) * 8 * 0x1p-24f * brdf.eval(a, b).g + 1e-9f);
      }
    }
  }
}

/// Pairs within narrow lobes, that few pairs of the hemisphere are: exchanged, the difference of direction
/// and mirror direction, and the sum that makes the half vector, change signs at most; 4 units in the last
/// place.
TEST(Phong, IsReciprocalWithinTheLobe) {
  for (const auto& lobe : lobes()) {
    for (const float n : {50.0f, 1e4f, 1e6f}) {
      const Material material = grey(0, 1, n, {.lobe = lobe.value});
      const Phong<true> brdf(material);
      Sampler random(14, 0, 0);
      int pairs = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 a = cosine_hemisphere(random.next_2d());
        const auto b = brdf.sample(a, 0.5f, random.next_2d());
        if (!b) continue;
        ++pairs;
        ASSERT_FLOAT_EQ(brdf.eval(a, b->wi).g, brdf.eval(b->wi, a).g) << n;
      }
      EXPECT_GT(pairs, 1500);
    }
  }
}

TEST(Phong, NormalisationIsAChoice) {
  const Material one = grey(0, 1, 3), two = grey(0, 1, 3, {.norm = PhongNorm::n_plus_2});
  const Vec3 up(0, 0, 1);
  EXPECT_FLOAT_EQ(Phong<true>(one).eval(up, up).g, static_cast<float>(4 / (2 * M_PI)));
  EXPECT_FLOAT_EQ(Phong<true>(two).eval(up, up).g, static_cast<float>(5 / (2 * M_PI)));
}

TEST(Phong, NothingBelowTheSurfaceAndNothingOfBlack) {
  const Material material = grey(0.3f, 0.5f, 10), black = make_material({}, {}, 10);
  const Vec3 up(0, 0, 1), down(0, 0, -1);
  EXPECT_EQ(Phong<true>(material).eval(up, down), Rgb{});
  EXPECT_EQ(Phong<true>(material).pdf(down, up).value, 0);
  EXPECT_FALSE(Phong<true>(black).sample(up, 0.5f, {0.5f, 0.5f}));
  EXPECT_FALSE(Phong<false>(black).sample(up, 0, {0.5f, 0.5f}));
}

}  // namespace
}  // namespace lemma
