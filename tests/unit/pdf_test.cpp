#include "src/core/pdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <limits>

#include "src/lights/light_sampler.h"
#include "src/shading/phong.h"

namespace lemma {
namespace {

// A density in one measure is refused where another is meant: these hold when compiling.

template <class A, class B>
concept CanBeWeighed = requires(A a, B b) {
  balance_heuristic(a, b);
  power_heuristic(a, b);
};
static_assert(CanBeWeighed<PdfSolidAngle, PdfSolidAngle>);
static_assert(!CanBeWeighed<PdfArea, PdfSolidAngle> && !CanBeWeighed<PdfSolidAngle, PdfArea>);
static_assert(!CanBeWeighed<PdfArea, PdfArea>, "areas on different lights do not compare");
static_assert(!CanBeWeighed<float, float>, "a bare number does not say what it is per");

template <class A, class B>
constexpr bool kInterchangeable = std::convertible_to<A, B> || std::assignable_from<B&, A>;
static_assert(!kInterchangeable<PdfArea, PdfSolidAngle> && !kInterchangeable<PdfSolidAngle, PdfArea>);
static_assert(!kInterchangeable<float, PdfSolidAngle> && !kInterchangeable<PdfSolidAngle, float>);

template <class P>
concept CanBeTurned = requires(P p) {
  { to_solid_angle(p, 1.0, 1.0) } -> std::same_as<PdfSolidAngle>;
};
static_assert(CanBeTurned<PdfArea> && !CanBeTurned<PdfSolidAngle>);

static_assert(std::same_as<decltype(LightSample::pdf), PdfSolidAngle>);
static_assert(std::same_as<decltype(BrdfSample::pdf), PdfSolidAngle>);

/// Of two techniques the weights of a direction sum to 1, whatever the densities.
TEST(Heuristics, WeightsOfADirectionSumToOne) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const auto weight : {balance_heuristic, power_heuristic}) {
    for (const float a : {1e-30f, 1e-3f, 1.0f, 7.0f, 1e30f}) {
      for (const float b : {1e-30f, 1e-3f, 1.0f, 7.0f, 1e30f}) {
        EXPECT_NEAR(weight({a}, {b}) + weight({b}, {a}), 1, 1e-6) << a << " " << b;
      }
      EXPECT_EQ(weight({a}, {0}), 1);
      EXPECT_EQ(weight({0}, {a}), 0);
      EXPECT_EQ(weight({infinity}, {a}), 1);
      EXPECT_EQ(weight({a}, {infinity}), 0);
    }
  }
}

TEST(Heuristics, AreTheirFormulas) {
  EXPECT_FLOAT_EQ(balance_heuristic({3}, {1}), 0.75f);
  EXPECT_FLOAT_EQ(power_heuristic({3}, {1}), 0.9f);
}

}  // namespace
}  // namespace lemma
