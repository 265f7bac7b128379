#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "src/shading/phong.h"

namespace lemma {
namespace {

Vec3 direction(double theta_degrees, double phi = 0.3) {
  const double theta = theta_degrees * M_PI / 180;
  return {static_cast<float>(std::sin(theta) * std::cos(phi)),
          static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta))};
}

Material glossy(float exponent, float kd = 0.3f, float ks = 0.5f, PhongNorm norm = PhongNorm::n_plus_1) {
  return make_material({kd, kd, kd}, {ks, ks, ks}, exponent, norm);
}

/// Integral of g over the hemisphere by the midpoint rule in (cos theta, phi): for smooth g, error below
/// 1e-4.
template <class G>
double integrate_hemisphere(const G& g) {
  constexpr int rows = 1000, columns = 2000;
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const double z = (i + 0.5) / rows, r = std::sqrt(1 - z * z);
    for (int j = 0; j < columns; ++j) {
      const double phi = 2 * M_PI * (j + 0.5) / columns;
      sum += g(Vec3(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                    static_cast<float>(z)));
    }
  }
  return sum * 2 * M_PI / rows / columns;
}

/// Directional albedo of the lobe alone with factor (n + 1) / (2 pi), by numerical quadrature to 5 digits.
TEST(Phong, DirectionalAlbedoOfTheLobe) {
  struct Row {
    float n;
    std::array<double, 5> albedo;
  };
  constexpr std::array<double, 5> angles{0, 30, 60, 75, 85};
  const Row rows[] = {{1, {.66667, .58723, .40600, .30563, .24206}},
                      {5, {.85715, .74250, .44521, .28040, .18562}},
                      {20, {.95455, .82666, .47776, .25885, .13201}},
                      {100, {.99020, .85754, .49510, .25641, .09666}}};
  for (const Row& row : rows) {
    const Material material = glossy(row.n, 0, 1);
    const Phong<true> brdf(material);
    for (std::size_t a = 0; a < angles.size(); ++a) {
      const Vec3 wo = direction(angles[a]);
      const double albedo =
          integrate_hemisphere([&](const Vec3& wi) { return double{brdf.eval(wo, wi).g} * wi.z; });
      // The midpoint rule over 1000 rows of cos(theta) errs by (n / 1000)^2 / 24 at a lobe's peak, where
      // eval's curve bends most; and directions in float32 by n roundings.
      EXPECT_NEAR(albedo, row.albedo[a], 2e-5 + 0.1 * row.n * row.n * 1e-6 + 2 * row.n * 0x1p-24)
          << "n " << row.n << " angle " << angles[a];
    }
  }
}

/// The part of the mixture's density above the surface: 1 less the share of lobe samples that fall below.
TEST(Phong, SampledShareEqualsIntegratedDensity) {
  for (const float n : {0.0f, 1.0f, 5.0f, 100.0f}) {
    for (const double angle : {0.0, 60.0, 85.0}) {
      const Material material = glossy(n);
      const Phong<true> brdf(material);
      const Vec3 wo = direction(angle);
      const double mass =
          integrate_hemisphere([&](const Vec3& wi) { return double{brdf.pdf(wo, wi).value}; });
      constexpr int draws = 200000;
      int above = 0;
      Sampler random(11, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(angle));
      for (int i = 0; i < draws; ++i) {
        const float choice = random.next();
        if (brdf.sample(wo, choice, random.next_2d())) ++above;
      }
      // A binomial share: 5 standard deviations are exceeded once in 1.7 million draws, 12 tests here.
      const double share = static_cast<double>(above) / draws;
      EXPECT_NEAR(share, mass, 5 * 0.5 / std::sqrt(draws) + 1e-4) << "n " << n << " angle " << angle;
    }
  }
}

TEST(Phong, SamplePdfAndEvalAgree) {
  for (const float n : {0.0f, 1.0f, 100.0f, 1e4f, 1e6f}) {
    const Material material = glossy(n);
    const Phong<true> brdf(material);
    Sampler random(12, static_cast<std::uint32_t>(n), 0);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 wo = cosine_hemisphere(random.next_2d());
      const float choice = random.next();
      const auto sample = brdf.sample(wo, choice, random.next_2d());
      if (!sample) continue;
      ASSERT_NEAR(length(sample->wi), 1, 1e-6);
      // The same expressions in another order: a few roundings.
      ASSERT_NEAR(sample->pdf.value / brdf.pdf(wo, sample->wi).value, 1, 1e-5);
      const Rgb expected = brdf.eval(wo, sample->wi) * (sample->wi.z / sample->pdf.value);
      ASSERT_NEAR(sample->weight.g, expected.g, 1e-5f * expected.g + 1e-12f);
    }
  }
}

TEST(Phong, IsReciprocal) {
  const Material material = glossy(50);
  const Phong<true> brdf(material);
  Sampler random(13, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = cosine_hemisphere(random.next_2d()), b = cosine_hemisphere(random.next_2d());
    // The lobe's exponent 50 multiplies a rounding of the angle.
    ASSERT_NEAR(brdf.eval(a, b).g, brdf.eval(b, a).g, 1e-4f * brdf.eval(a, b).g + 1e-9f);
  }
}

/// Narrow lobes keep their digits: with sharp exponents the mean of 1 - cos(alpha) over samples is 1 / (n +
/// 2).
TEST(Phong, NarrowLobesAreSampledWithTheRightWidth) {
  for (const float n : {1e3f, 1e5f, 1e6f}) {
    const Material material = glossy(n, 0, 1);
    const Phong<true> brdf(material);
    const Vec3 wo = direction(30), mirror(-wo.x, -wo.y, wo.z);
    constexpr int draws = 100000;
    double sum = 0;
    Sampler random(14, static_cast<std::uint32_t>(n), 0);
    for (int i = 0; i < draws; ++i) {
      const auto sample = brdf.sample(wo, 0.5f, random.next_2d());
      ASSERT_TRUE(sample);
      const Vec3d d = Vec3d(sample->wi) - Vec3d(mirror);
      sum += 0.5 * dot(d, d);
    }
    // Relative standard deviation of one value is about 1; roundings of unit vectors, 6e-8, shift d^2 / 2 by
    // 1e-14.
    EXPECT_NEAR(sum / draws * (n + 2), 1, 5 / std::sqrt(draws) + 1e-2 * (n / 1e6)) << n;
  }
}

TEST(Phong, NormalisationIsAChoice) {
  const Material one = glossy(3, 0, 1, PhongNorm::n_plus_1), two = glossy(3, 0, 1, PhongNorm::n_plus_2);
  const Vec3 up(0, 0, 1);
  EXPECT_FLOAT_EQ(Phong<true>(one).eval(up, up).g, static_cast<float>(4 / (2 * M_PI)));
  EXPECT_FLOAT_EQ(Phong<true>(two).eval(up, up).g, static_cast<float>(5 / (2 * M_PI)));
}

TEST(Phong, NothingBelowTheSurfaceAndNothingOfBlack) {
  const Material material = glossy(10), black = make_material({}, {}, 10, PhongNorm::n_plus_1);
  const Vec3 up(0, 0, 1), down(0, 0, -1);
  EXPECT_EQ(Phong<true>(material).eval(up, down), Rgb{});
  EXPECT_EQ(Phong<true>(material).pdf(down, up).value, 0);
  EXPECT_FALSE(Phong<true>(black).sample(up, 0.5f, {0.5f, 0.5f}));
  EXPECT_FALSE(Phong<false>(black).sample(up, 0, {0.5f, 0.5f}));
}

TEST(Phong, ExtremeNumbersGiveFiniteSamples) {
  constexpr float last = 1 - 0x1p-24f;
  for (const float n : {0.0f, 1.0f, 1e6f}) {
    const Material material = glossy(n);
    const Phong<true> brdf(material);
    for (const float choice : {0.0f, last}) {
      for (const Vec2& u : {Vec2(0, 0), Vec2(last, 0), Vec2(0, last), Vec2(last, last)}) {
        for (const double angle : {0.0, 45.0, 89.99}) {
          const auto sample = brdf.sample(direction(angle), choice, u);
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

}  // namespace
}  // namespace lemma
