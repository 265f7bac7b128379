#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "src/shading/phong.h"
#include "tests/support/hemisphere.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

using test::direction;

/// The ways to draw a direction: the Phong lobe whole or cut at the horizon, Blinn's lobe.
constexpr BrdfOptions kSamplings[] = {
    {.sampling = LobeSampling::truncated}, {.sampling = LobeSampling::p6}, {.lobe = Lobe::blinn_phong}};

Material mixed(float exponent, const BrdfOptions& options) {
  return make_material({0.3f, 0.3f, 0.3f}, {0.5f, 0.5f, 0.5f}, exponent, options);
}

Material lobe_alone(float exponent, const BrdfOptions& options) {
  return make_material({}, {1, 1, 1}, exponent, options);
}

std::string describe(const BrdfOptions& o) {
  return std::string(name_of(lobes(), o.lobe)) + " " + std::string(name_of(lobe_samplings(), o.sampling));
}

Vec3 mirror(const Vec3& wo) {
  return {-wo.x, -wo.y, wo.z};
}

class EverySampling : public testing::TestWithParam<BrdfOptions> {};
INSTANTIATE_TEST_SUITE_P(Brdf, EverySampling, testing::ValuesIn(kSamplings));

/// Where the samples of a lobe are counted: the Phong lobe's by their direction about the mirror direction,
/// Blinn's by their half vector about the normal, for at grazing angles directions are stretched along one
/// line. The densities differ by dwi = 4 (wo . h) dh.
struct Domain {
  Vec3 wo;
  bool half_vectors;

  [[nodiscard]] Vec3 axis() const { return half_vectors ? Vec3(0, 0, 1) : mirror(wo); }
  [[nodiscard]] Vec3 from(const Vec3& wi) const { return half_vectors ? normalize(wo + wi) : wi; }

  /// The density at a point of the domain.
  [[nodiscard]] double density(const Phong<true>& brdf, const Vec3& point) const {
    if (!half_vectors) return brdf.pdf(wo, point).value;
    const float cos_h = dot(wo, point);
    return cos_h > 0 ? 4.0 * cos_h * brdf.pdf(wo, point * (2 * cos_h) - wo).value : 0.0;
  }
};

/// Cells of the sphere about an axis: fine rings where the lobe is, coarse ones beyond.
class Cells {
 public:
  /// @param n  exponent of the lobe about the axis
  explicit Cells(const Vec3& axis, double n) : about_(axis) {
    for (const double left : {1.0, 0.9, 0.75, 0.6, 0.45, 0.3, 0.2, 0.1, 0.03, 1e-3, 1e-5}) {
      edges_.push_back(-std::expm1(std::log(left) / (n + 1)));  // so that a part of `left` lies outside
    }
    const double last = edges_.back();
    for (int i = 1; i <= 12; ++i) edges_.push_back(last + (2 - last) * i / 12);
  }

  [[nodiscard]] std::size_t count() const { return (edges_.size() - 1) * kColumns; }

  [[nodiscard]] std::size_t of(const Vec3& w) const {
    const auto above = std::upper_bound(edges_.begin(), edges_.end() - 1, about_.one_minus_cos(w));
    const auto ring = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - edges_.begin() - 1, 0));
    const double turn = about_.azimuth(w) / (2 * std::numbers::pi) + 0.5;
    return ring * kColumns + std::min(static_cast<std::size_t>(turn * kColumns), kColumns - 1);
  }

  /// Integral of a density over one cell, by the midpoint rule.
  template <class Density>
  [[nodiscard]] double integrate(std::size_t cell, const Density& density) const {
    constexpr int steps = 40;
    const std::size_t ring = cell / kColumns;
    const double height = edges_[ring + 1] - edges_[ring], width = 2 * std::numbers::pi / kColumns;
    const double left = width * static_cast<double>(cell % kColumns) - std::numbers::pi;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < steps; ++j) {
        sum +=
            density(about_.at(edges_[ring] + height * (i + 0.5) / steps, left + width * (j + 0.5) / steps));
      }
    }
    return sum / (steps * steps) * height * width;
  }

 private:
  static constexpr std::size_t kColumns = 16;
  test::AboutAxis about_;
  std::vector<double> edges_;  // of 1 - cos(alpha), 0 to 2
};

/// Chi-square of sample() against pdf(), with the samples that are lost as a cell of their own. Cells that
/// expect fewer than 5 are pooled.
/// @return the probability of so large a deviation
double chi_square(const Material& material, const Vec3& wo, std::uint32_t stream) {
  constexpr int draws = 60000;
  const Phong<true> brdf(material);
  const Domain domain{wo, material.lobe == Lobe::blinn_phong};
  const Cells cells(domain.axis(), material.exponent);
  std::vector<int> counts(cells.count());
  int lost = 0;
  Sampler random(11, stream, 0);
  for (int i = 0; i < draws; ++i) {
    const float choice = random.next();
    const auto sample = brdf.sample(wo, choice, random.next_2d());
    sample ? ++counts[cells.of(domain.from(sample->wi))] : ++lost;
  }
  double chi2 = 0, pooled_expected = 0, pooled_count = 0, mass = 0;
  int degrees = -1;
  const auto add = [&](double count, double expected) {
    chi2 += (count - expected) * (count - expected) / expected;
    ++degrees;
  };
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    const double share =
        cells.integrate(cell, [&](const Vec3& point) { return domain.density(brdf, point); });
    mass += share;
    if (share * draws >= 5) {
      add(counts[cell], share * draws);
    } else {
      pooled_expected += share * draws;
      pooled_count += counts[cell];
    }
  }
  // What is left of 1 is lost below the horizon; the quadrature knows it to 1e-3 where the horizon cuts
  // cells.
  const double lost_expected = std::max(1 - mass, 0.0) * draws;
  EXPECT_NEAR(mass + static_cast<double>(lost) / draws, 1, 1e-3 + 5 * std::sqrt(0.25 / draws));
  if (lost_expected >= 5) {
    add(lost, lost_expected);
  } else {
    pooled_expected += lost_expected;
    pooled_count += lost;
  }
  if (pooled_expected >= 5) add(pooled_count, pooled_expected);
  return test::chi_square_tail(chi2, degrees);
}

/// Whether float32 directions are too coarse to hold the lobe: a rounding of wi turns the half vector by
/// 2^-24 / (2 cos(theta_o)), here by more than a hundredth of the lobe's width n^(-1/2).
bool is_beyond_float(const BrdfOptions& options, float n, double angle) {
  const double cos_o = direction(angle).z;
  return options.lobe == Lobe::blinn_phong && 0x1p-24 / (2 * cos_o) * std::sqrt(n) > 0.01;
}

/// False alarms: 1e-3 over all cases together, by Sidak's correction.
TEST(BrdfSampling, SamplesFollowTheDensity) {
  constexpr float exponents[] = {0, 1, 100, 5000, 1e6f};
  constexpr double angles[] = {0, 45, 75, 89, 89.9};
  constexpr int cases = 3 * 2 * 5 * 5 - 2;  // less what float cannot hold: Blinn's, n 1e6, 89.9 degrees
  const double smallest = -std::expm1(std::log1p(-1e-3) / cases);
  std::uint32_t stream = 0;
  for (const BrdfOptions& options : kSamplings) {
    for (const float n : exponents) {
      for (const double angle : angles) {
        if (is_beyond_float(options, n, angle)) continue;
        for (const Material& material : {mixed(n, options), lobe_alone(n, options)}) {
          EXPECT_GT(chi_square(material, direction(angle), stream++), smallest)
              << describe(options) << ", n " << n << ", " << angle << " degrees, kd " << material.kd.g;
        }
      }
    }
  }
  EXPECT_EQ(stream, cases);
}

/// The density is the inverse of the area that the unit square of numbers is stretched to. Central
/// differences over h err by h^2 of the third derivative, and by 1e-7 / h for float directions.
TEST_P(EverySampling, DensityIsTheInverseJacobian) {
  for (const float n : {0.0f, 1.0f, 20.0f, 100.0f}) {
    const Material material = lobe_alone(n, GetParam());
    const Phong<true> brdf(material);
    for (const double angle : {0.0, 50.0, 80.0}) {
      const Vec3 wo = direction(angle);
      for (const float u : {0.2f, 0.5f, 0.8f}) {
        for (const float v : {0.15f, 0.4f, 0.7f, 0.9f}) {
          constexpr float h = 1.0f / 1024;
          const auto at = [&](float a, float b) { return brdf.sample(wo, 0.5f, {a, b}); };
          const auto s = at(u, v), left = at(u - h, v), right = at(u + h, v), down = at(u, v - h),
                     up = at(u, v + h);
          if (!s || !left || !right || !down || !up) continue;
          const Vec3 along = (right->wi - left->wi) / (2 * h), across = (up->wi - down->wi) / (2 * h);
          EXPECT_NEAR(length(cross(along, across)) * s->pdf.value, 1, 4e-3)
              << "n " << n << ", " << angle << " degrees, u " << u << " " << v;
        }
      }
    }
  }
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
