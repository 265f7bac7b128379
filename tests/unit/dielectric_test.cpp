#include "src/shading/dielectric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/core/error_bound.h"

namespace lemma {
namespace {

constexpr Rgb kTint{0.8f, 1, 0.95f};

/// Unit, at an angle [degrees] to z, above or below the surface.
Vec3 direction(double degrees, double side = 1) {
  const double a = degrees * std::numbers::pi / 180;
  return {static_cast<float>(std::sin(a)), 0, static_cast<float>(side * std::cos(a))};
}

TEST(Dielectric, ReflectanceAtNormalIncidence) {
  // ((eta - 1) / (eta + 1))^2 from either side; five roundings.
  EXPECT_NEAR(fresnel(1, 1.5f), 0.04, 0.04 * 5 * kRoundoff * 6);  // eta - 1 cancels: a factor of 3 twice
  EXPECT_NEAR(fresnel(1, 1 / 1.5f), 0.04, 0.04 * 5 * kRoundoff * 12);
  EXPECT_EQ(fresnel(1, 1), 0);
}

TEST(Dielectric, ReflectanceByTheAmplitudesOfSineAndTangent) {
  // Fresnel's own form: sin^2(i - t) / sin^2(i + t) and tan^2(i - t) / tan^2(i + t), in double.
  for (const double eta : {1.5, 1 / 1.5, 2.4}) {
    for (const double degrees : {1.0, 20.0, 40.0, 41.0, 60.0, 80.0, 89.0}) {
      const double i = degrees * std::numbers::pi / 180, sin_t = std::sin(i) / eta;
      const float found = fresnel(static_cast<float>(std::cos(i)), static_cast<float>(eta));
      if (sin_t >= 1) {
        EXPECT_EQ(found, 1) << "total internal reflection";
        continue;
      }
      const double t = std::asin(sin_t), s = std::sin(i - t) / std::sin(i + t),
                   p = std::tan(i - t) / std::tan(i + t);
      // The cosines carry a few roundings; their relative error grows as 1 / cos^2 near grazing, here up to
      // 1 / cos^2(89 degrees) = 3300, and for the refracted one near the critical angle.
      const double cos_least = std::min(std::cos(i), std::cos(t));
      EXPECT_NEAR(found, 0.5 * (s * s + p * p), 20 * kRoundoff / (cos_least * cos_least))
          << eta << " " << degrees;
    }
  }
}

TEST(Dielectric, MirrorAndRefractionBySnell) {
  const Dielectric glass{1.5f, kTint};
  for (const double side : {1.0, -1.0}) {
    const double eta = side > 0 ? 1.5 : 1 / 1.5;
    const Vec3 wo = direction(30, side);
    const DielectricSample mirrored = sample_dielectric(glass, wo, 0);
    EXPECT_FALSE(mirrored.refracted);
    EXPECT_EQ(mirrored.wi, Vec3(-wo.x, 0, wo.z));
    EXPECT_EQ(mirrored.weight, (Rgb{1, 1, 1}));
    const DielectricSample refracted = sample_dielectric(glass, wo, 0.999f);
    EXPECT_TRUE(refracted.refracted);
    EXPECT_EQ(refracted.weight, kTint);
    EXPECT_NEAR(refracted.wi.x, -0.5 / eta, 8 * kRoundoff);
    EXPECT_NEAR(refracted.wi.z, -side * std::sqrt(1 - 0.25 / (eta * eta)), 8 * kRoundoff);
  }
}

TEST(Dielectric, TotalInternalReflectionBeyondTheCriticalAngle) {
  const double critical = std::asin(1 / 1.5) * 180 / std::numbers::pi;  // 41.8 degrees
  const Dielectric glass{1.5f, kTint};
  EXPECT_FALSE(sample_dielectric(glass, direction(critical + 0.1, -1), 0.999999f).refracted);
  EXPECT_TRUE(sample_dielectric(glass, direction(critical - 0.1, -1), 0.999999f).refracted);
  EXPECT_TRUE(sample_dielectric(glass, direction(89, 1), 0.999999f).refracted) << "never from outside";
}

TEST(Dielectric, ThePathBackIsThePathThere) {
  const Dielectric glass{1.5f, kTint};
  const Vec3 wo = direction(50);
  const Vec3 inside = sample_dielectric(glass, wo, 0.999f).wi;
  const Vec3 back = sample_dielectric(glass, inside, 0.999f).wi;
  EXPECT_NEAR(length(back - wo), 0, 16 * kRoundoff);
}

}  // namespace
}  // namespace lemma
