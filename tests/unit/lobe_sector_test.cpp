// Directions to a light by the lobe of the surface that looks at it.
#include "src/lights/lobe_sector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/core/sampler.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

/// A lobe whose mirror direction makes this angle with the axis of cones around z.
Reflection lobe_beside_z(double angle, float width) {
  const Vec3 mirror(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
  return {.mirror = mirror, .diffuse = 0.01f, .peak = 0.1f / width, .width = width};
}

/// A lobe and a cone of which the sector serves better than directions uniform over the cone.
struct SectorCase {
  double angle;  // from mirror direction to axis
  float width;
  double radius;  // of a sphere at distance 1
};
// The mirror direction in the middle, off it, at the rim, beside; tiny and nearly a hemisphere.
constexpr SectorCase kSectors[] = {{0, 1e-3f, 0.2},     {0.1, 1e-3f, 0.2},   {0.2, 1e-3f, 0.2},
                                   {0.3, 5e-3f, 0.2},   {3e-3, 1e-6f, 2e-3}, {0.9, 0.05f, 0.9},
                                   {1.6, 0.3f, 0.9899}, {0, 0.5f, 0.9899}};

/// Cells of a cone around z, of equal solid angles.
class ConeCells {
 public:
  explicit ConeCells(const SphereCone& cone) : one_minus_cos_(cone.one_minus_cos()) {}

  [[nodiscard]] std::size_t of(const Vec3d& w) const {
    const double below = 0.5 * (w.x * w.x + w.y * w.y + (w.z - 1) * (w.z - 1)) / one_minus_cos_;
    const double turn = std::atan2(w.y, w.x) * 0.5 * std::numbers::inv_pi + 0.5;
    const auto index = [](double part, std::size_t count) {
      return std::min(static_cast<std::size_t>(part * static_cast<double>(count)), count - 1);
    };
    return index(below, kRings) * kColumns + index(turn, kColumns);
  }

  /// Of a density over each cell, by the midpoint rule.
  template <class Density>
  [[nodiscard]] std::vector<double> integrals(const Density& density) const {
    constexpr std::size_t steps = 24;
    std::vector<double> integrals(kRings * kColumns, 0.0);
    const double share =
        2 * std::numbers::pi * one_minus_cos_ / static_cast<double>(integrals.size() * steps * steps);
    for (std::size_t i = 0; i < kRings * steps; ++i) {
      const double below = one_minus_cos_ * (static_cast<double>(i) + 0.5) / (kRings * steps);
      const double sine = std::sqrt(below * (2 - below));
      for (std::size_t j = 0; j < kColumns * steps; ++j) {
        const double phi = std::numbers::pi * (2 * (static_cast<double>(j) + 0.5) / (kColumns * steps) - 1);
        integrals[i / steps * kColumns + j / steps] +=
            share * density({sine * std::cos(phi), sine * std::sin(phi), 1 - below});
      }
    }
    return integrals;
  }

 private:
  static constexpr std::size_t kRings = 20, kColumns = 24;
  double one_minus_cos_;
};

TEST(LobeSector, DensityIsTheInverseJacobian) {
  for (const auto& [angle, width, radius] : kSectors) {
    const SphereCone cone({0, 0, 1}, radius, {0, 0, 0});
    const LobeSector sector = LobeSector::find(lobe_beside_z(angle, width), cone).value();
    ASSERT_GT(sector.share(), 0) << angle;
    ASSERT_LT(sector.share(), 1) << angle;
    for (const Vec2& u : {Vec2(0.25f, 0.25f), Vec2(0.5f, 0.75f), Vec2(0.75f, 0.125f)}) {
      constexpr float h = 0x1p-10f;
      const Vec3d du = (sector.sample(u + Vec2(h, 0)) - sector.sample(u - Vec2(h, 0))) * (0.5 / h);
      const Vec3d dv = (sector.sample(u + Vec2(0, h)) - sector.sample(u - Vec2(0, h))) * (0.5 / h);
      const double density = double{sector.pdf(sector.sample(u)).value};
      // Central differences err as for the cone. Mirror directions are unit to 2^-24 only: over the lobe's
      // width, 1e-6 at least, and the distance of 3e-3 from it that is 1e-3.
      EXPECT_NEAR(length(cross(du, dv)) * density, 1, 2e-3) << angle << " " << u;
    }
  }
}

/// All directions of the cone can be drawn: those that are drawn within it, each counted by 1 / density, add
/// up to its solid angle. False alarms: one in 10^4 for all cases together.
TEST(LobeSector, CoversTheCone) {
  for (const auto& [angle, width, radius] : kSectors) {
    const SphereCone cone({0, 0, 1}, radius, {0, 0, 0});
    const LobeSector sector = LobeSector::find(lobe_beside_z(angle, width), cone).value();
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 40000; ++i) {
      Sampler random(46, i, 0);
      const bool uniform = random.next() < 0.5f;  // which keeps 1 / density bounded
      const Vec2 u = random.next_2d();
      const Vec3d w = uniform ? cone.sample(u) : sector.sample(u);
      const double density = 0.5 / cone.solid_angle() + 0.5 * double{sector.pdf(w).value};
      values.push_back(cone.holds(w) ? 1 / (density * cone.solid_angle()) : 0);
    }
    const test::Estimate covered = test::estimate(values);
    EXPECT_LT(std::abs(covered.mean - 1), test::z_limit(1e-4, std::size(kSectors)) * covered.standard_error)
        << angle << " " << covered.mean << " +- " << covered.standard_error;
  }
}

/// Samples by cells of the cone against the integral of the density; what is left of 1 misses the cone. False
/// alarms: 1e-3 for all cases together.
TEST(LobeSector, SamplesFollowTheDensityWithinTheCone) {
  constexpr std::uint32_t draws = 40000;
  const double smallest = -std::expm1(std::log1p(-1e-3) / static_cast<double>(std::size(kSectors)));
  for (const auto& [angle, width, radius] : kSectors) {
    const SphereCone cone({0, 0, 1}, radius, {0, 0, 0});
    const LobeSector sector = LobeSector::find(lobe_beside_z(angle, width), cone).value();
    const ConeCells cells(cone);
    auto shares = cells.integrals([&](const Vec3d& w) { return double{sector.pdf(w).value}; });
    double rest = 1;
    for (const double share : shares) rest -= share;
    ASSERT_GT(rest, -1e-3) << angle;
    shares.push_back(std::max(rest, 0.0));  // misses the cone
    std::vector<double> counts(shares.size(), 0.0);
    Sampler random(47, 0, 0);
    for (std::uint32_t i = 0; i < draws; ++i) {
      const Vec3d w = sector.sample(random.next_2d());
      ++counts[cone.holds(w) ? cells.of(w) : counts.size() - 1];
    }
    EXPECT_GT(test::chi_square_test(counts, shares), smallest) << angle << ", missed " << rest;
  }
}

TEST(LobeSector, IsNotUsedWhereTheConeServesBetter) {
  const SphereCone cone({0, 0, 1}, 0.1, {0, 0, 0});
  EXPECT_FALSE(LobeSector::find(Reflection{}, cone));               // no lobe
  EXPECT_FALSE(LobeSector::find(lobe_beside_z(0.05, 0.1f), cone));  // a much wider one
  EXPECT_FALSE(LobeSector::find(lobe_beside_z(3, 1e-6f), cone));    // one that reflects nothing of the cone
}

TEST(LobeSector, SamplesStayInTheSectorAtTheExtremesOfU) {
  constexpr float last = 1 - 0x1p-24f;
  for (const auto& [angle, width, radius] : kSectors) {
    const SphereCone cone({0, 0, 1}, radius, {0, 0, 0});
    const LobeSector sector = LobeSector::find(lobe_beside_z(angle, width), cone).value();
    for (const Vec2& u : {Vec2(0, 0), Vec2(last, 0), Vec2(0, last), Vec2(last, last)}) {
      const Vec3d w = sector.sample(u);
      EXPECT_NEAR(length(w), 1, 1e-15);
      EXPECT_TRUE(std::isfinite(sector.pdf(w).value));
    }
  }
}

}  // namespace
}  // namespace lemma
