// Samples of BRDFs against their density and their albedo.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "src/core/sampler.h"
#include "src/shading/phong.h"
#include "tests/support/brdfs.h"
#include "tests/support/hemisphere.h"
#include "tests/support/statistics.h"

namespace lemma {
namespace {

using test::direction;
using test::lobe_alone;
using test::mirror;
using test::mixed;

std::string describe(const BrdfOptions& o) {
  return std::string(name_of(lobes(), o.lobe)) + " " + std::string(name_of(lobe_samplings(), o.sampling));
}

/// Where the samples of a lobe are counted: the Phong lobe's by their direction about the mirror direction,
/// Blinn's by their half vector about the normal, for at grazing angles directions are stretched along one
/// line. The densities differ by dwi = 4 (wo . h) dh.
struct Domain {
  Vec3 wo;
  bool half_vectors;

  [[nodiscard]] Vec3 axis() const { return half_vectors ? Vec3(0, 0, 1) : mirror(wo); }
  [[nodiscard]] Vec3 from(const Vec3& wi) const { return half_vectors ? normalize(wo + wi) : wi; }

  /// Directions about the axis lie above the surface within so much of the azimuth of wo, or of the normal.
  /// A half vector turned by alpha turns wi by 2 alpha.
  [[nodiscard]] double largest_azimuth(double one_minus_cos) const {
    const double alpha = std::acos(std::clamp(1 - one_minus_cos, -1.0, 1.0));
    const double turn = half_vectors ? 2 * alpha : alpha;
    const double along = wo.z * std::cos(turn), across = std::hypot(wo.x, wo.y) * std::sin(turn);
    return std::atan2(std::sqrt(std::max(across * across - along * along, 0.0)), -along);
  }

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

  /// Integral of a density over one cell, by the midpoint rule on either side of the horizon. Rows are
  /// even in sqrt(1 - cos): at grazing angles the horizon bends away from the plane of wo like 1 / alpha.
  template <class Density>
  [[nodiscard]] double integrate(std::size_t cell, const Domain& domain, const Density& density) const {
    constexpr int rows = 24, columns = 6;
    const std::size_t ring = cell / kColumns;
    const double inner = std::sqrt(edges_[ring]), height = (std::sqrt(edges_[ring + 1]) - inner) / rows;
    const double width = 2 * std::numbers::pi / kColumns;
    const double left = width * static_cast<double>(cell % kColumns) - std::numbers::pi;
    const double middle = domain.half_vectors ? about_.azimuth(domain.wo) : 0;
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
      const double root = inner + height * (i + 0.5), one_minus_cos = root * root;
      const double half = domain.largest_azimuth(one_minus_cos);
      std::array cuts{left, left + width, left, left};
      for (const int side : {0, 1}) {
        const double horizon = std::remainder(middle + (side == 0 ? half : -half), 2 * std::numbers::pi);
        cuts[2 + side] = std::clamp(horizon, left, left + width);
      }
      std::ranges::sort(cuts);
      for (std::size_t piece = 0; piece + 1 < cuts.size(); ++piece) {
        const double step = (cuts[piece + 1] - cuts[piece]) / columns;
        for (int j = 0; step > 0 && j < columns; ++j) {
          sum += 2 * root * step * density(about_.at(one_minus_cos, cuts[piece] + step * (j + 0.5)));
        }
      }
    }
    return sum * height;
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
        cells.integrate(cell, domain, [&](const Vec3& point) { return domain.density(brdf, point); });
    mass += share;
    if (share * draws >= 5) {
      add(counts[cell], share * draws);
    } else {
      pooled_expected += share * draws;
      pooled_count += counts[cell];
    }
  }
  // What is left of 1 is lost below the horizon.
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

class BrdfChiSquare : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Brdf, BrdfChiSquare,
                         testing::Range(0u, static_cast<std::uint32_t>(std::size(test::kSamplings))));

/// False alarms: 1e-3 over all cases together, by Sidak's correction.
TEST_P(BrdfChiSquare, SamplesFollowTheDensity) {
  constexpr float exponents[] = {0, 1, 5, 100, 5000, 1e6f};
  constexpr double angles[] = {0, 45, 75, 89, 89.9};
  constexpr int cases = 2 * 6 * 5, all = 3 * cases - 2;
  const BrdfOptions& options = test::kSamplings[GetParam()];
  const double smallest = -std::expm1(std::log1p(-1e-3) / all);
  std::uint32_t stream = cases * GetParam();
  int left_out = 0;
  for (const float n : exponents) {
    for (const double angle : angles) {
      for (const Material& material : {mixed(n, options), lobe_alone(n, options)}) {
        if (is_beyond_float(options, n, angle)) {
          ++left_out;
          continue;
        }
        EXPECT_GT(chi_square(material, direction(angle), stream++), smallest)
            << describe(options) << ", n " << n << ", " << angle << " degrees, kd " << material.kd.g;
      }
    }
  }
  EXPECT_EQ(left_out, options.lobe == Lobe::blinn_phong ? 2 : 0);  // n 1e6, 89.9 degrees
}

/// Albedo of Blinn's lobe for ks = 1, in double, by the midpoint rule over the half vectors as they are
/// drawn.
double blinn_albedo_in_double(float n, const Vec3& direction) {
  constexpr int rows = 1000, columns = 1000;
  const Vec3d wo = normalize(Vec3d(direction));
  const double sharpness = n, factor = (sharpness + 2) * (sharpness + 4) /
                                       (8 * std::numbers::pi * (std::exp2(-sharpness / 2) + sharpness));
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const double x = -std::expm1(std::log((i + 0.5) / rows) / (sharpness + 1)), sine = std::sqrt(x * (2 - x));
    for (int j = 0; j < columns; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / columns;
      const Vec3d h(sine * std::cos(phi), sine * std::sin(phi), 1 - x);
      const double cos_h = dot(wo, h), z = 2 * cos_h * h.z - wo.z;
      if (cos_h > 0 && z > 0) sum += z * 4 * cos_h;
    }
  }
  return factor * 2 * std::numbers::pi / (sharpness + 1) * sum / (rows * columns);
}

/// Where float32 directions blur the lobe, its mean is still right. False alarms: 1e-3 for the cases
/// together; beside them 3e-4 for the rule, whose albedos with four times the points an axis differ by 2.6e-4
/// at most.
TEST(BlinnLobe, MeanWeightAtGrazingAngles) {
  constexpr float exponents[] = {1e4f, 1e5f, 1e6f};
  constexpr double angles[] = {80, 89, 89.9, 89.99};
  const double limit = test::z_limit(1e-3, 3 * 4);
  for (const float n : exponents) {
    const Material material = lobe_alone(n, {.lobe = Lobe::blinn_phong});
    for (const double angle : angles) {
      const Vec3 wo = direction(angle);
      std::vector<double> weights;
      Sampler random(16, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(100 * angle));
      for (int i = 0; i < 100000; ++i) {
        const auto sample = Phong<true>(material).sample(wo, 0.5f, random.next_2d());
        weights.push_back(sample ? double{sample->weight.g} : 0.0);
      }
      const test::Estimate e = test::estimate(weights);
      const double albedo = blinn_albedo_in_double(n, wo);
      EXPECT_LT(std::abs(e.mean - albedo), limit * e.standard_error + 3e-4 * albedo)
          << "n " << n << ", " << angle << " degrees: " << e.mean << ", expected " << albedo;
    }
  }
}

}  // namespace
}  // namespace lemma
