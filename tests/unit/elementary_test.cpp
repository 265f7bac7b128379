#include "src/core/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace lemma {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kSteps = 200000;

/// Values of [0, largest]: evenly spread, and of every magnitude down to 1e-300.
template <class Use>
void for_sizes(double largest, const Use& use) {
  std::mt19937_64 random(91);
  std::uniform_real_distribution<double> uniform(0, 1), magnitude(-300, 0);
  use(0.0), use(largest);
  for (int i = 0; i < kSteps; ++i) use(largest * uniform(random));
  for (int i = 0; i < kSteps; ++i) use(largest * std::pow(10.0, magnitude(random)));
}

/// The relative error of a double, held against long double's function, whose own is below 2^-63.
void expect_within(double found, long double expected, double tolerance, double x) {
  if (expected == 0) {
    ASSERT_EQ(found, 0) << x;
  } else {
    ASSERT_LE(static_cast<double>(std::abs(found / expected - 1)), tolerance) << x;
  }
}

/// Within 0.5001 units in the last place of a float; a unit is that of the binade of the expected value.
void expect_rounded(float found, long double expected, float x) {
  const int exponent = std::max(std::ilogb(expected), -126);  // below, subnormal numbers
  const long double unit = std::ldexp(1.0L, exponent - 23);
  ASSERT_LE(static_cast<double>(std::abs(found - expected) / unit), 0.5001) << x;
}

// The errors of doubles are those that the functions state: what their polynomials leave, and a dozen
// roundings of 2^-53, 1.3e-15; above 1/2 the arc sine is a difference that doubles the first.

TEST(Elementary, Exponential) {
  for_sizes(708, [](double size) {
    for (const double x : {-size, std::min(size, 709.0)}) {
      expect_within(elementary::exp(x), std::exp(static_cast<long double>(x)), 2e-14, x);
    }
  });
}

TEST(Elementary, ExponentialBeyondItsRange) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(elementary::exp(-708.1), 0);
  EXPECT_EQ(elementary::exp(-infinite), 0);
  EXPECT_TRUE(std::isnan(elementary::exp(kNaN)));
}

TEST(Elementary, ExponentialLessOne) {
  for_sizes(708, [](double size) {
    expect_within(elementary::expm1(-size), std::expm1(static_cast<long double>(-size)), 4e-14, -size);
  });
  EXPECT_TRUE(std::isnan(elementary::expm1(kNaN)));
}

TEST(Elementary, LogarithmOfOnePlus) {
  for_sizes(1 - 0x1p-53, [](double size) {
    expect_within(elementary::log1p(-size), std::log1p(static_cast<long double>(-size)), 4e-14, -size);
    const double above = std::min(1 - size * 0x1p-20, 1 - 0x1p-53);  // near -1
    expect_within(elementary::log1p(-above), std::log1p(static_cast<long double>(-above)), 4e-14, -above);
  });
  EXPECT_TRUE(std::isnan(elementary::log1p(kNaN)));
  for (const double x : {-1.0, -1.5, -2.0}) EXPECT_TRUE(std::isfinite(elementary::log1p(x)));
}

TEST(Elementary, ArcSine) {
  for_sizes(1, [](double size) {
    for (const double x : {-size, size, 1 - size, size - 1}) {
      expect_within(elementary::asin(x), std::asin(static_cast<long double>(x)), 3e-14, x);
      const auto y = static_cast<float>(x);
      expect_rounded(elementary::asin(y), std::asin(static_cast<long double>(y)), y);
    }
  });
  for (const double x : {kNaN, -1.0000001, 1.0000001}) EXPECT_TRUE(std::isnan(elementary::asin(x)));
}

/// The polynomial's 1.7e-8; six roundings of 2^-24 of the angle, which the difference from pi / 2 may double
/// when it is least, pi / 6.
TEST(Elementary, ArcSineInSinglePrecision) {
  for_sizes(1, [](double size) {
    for (const auto x : {static_cast<float>(size), static_cast<float>(1 - size)}) {
      expect_within(double{elementary::asin_in_single(x)}, std::asin(static_cast<long double>(x)), 4e-7,
                    double{x});
    }
  });
}

}  // namespace
}  // namespace lemma
