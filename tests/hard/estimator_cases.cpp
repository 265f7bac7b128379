#include <cmath>
#include <vector>

#include "src/core/sampler.h"
#include "src/render/film.h"
#include "src/shading/lobe.h"
#include "src/shading/phong.h"
#include "tests/hard/hard_case.h"
#include "tests/support/hemisphere.h"
#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma::test {
namespace {

constexpr BrdfOptions kBrdfs[] = {{.sampling = LobeSampling::truncated},
                                  {.sampling = LobeSampling::p6},
                                  {.norm = PhongNorm::n_plus_2},
                                  {.lobe = Lobe::blinn_phong}};

Material lobe_of(float n, const BrdfOptions& options) {
  return make_material({}, {1, 1, 1}, n, options);
}

void count(Outcome& outcome, bool right) {
  ++outcome.rays;
  outcome.faults += right ? 0 : 1;
}

/// 20: the lobe against (n + 1) / (2 pi) (1 - x)^n in long double, x = 1 - cos(alpha) of the very directions;
/// relative error 1e-4 at n = 1e5, where roundings of unit vectors, u |d| each, are multiplied by n.
Outcome exponent_ladder(std::string_view) {
  Outcome outcome;
  for (const float n : {0.0f, 1.0f, 100.0f, 1e4f, 1e5f, 1e6f}) {
    const Material material = lobe_of(n, {});
    const Vec3 wo = direction(35), mirror(-wo.x, -wo.y, wo.z);
    const AboutAxis about(mirror);
    for (int i = 1; i < 1000; ++i) {
      const Vec3 wi = about.at(-std::expm1(std::log(i / 1000.0) / (n + 1)), i);
      if (wi.z <= 0) continue;
      const double x = about.one_minus_cos(wi);
      const auto expected = static_cast<double>((n + 1.0L) / (2 * M_PIl) *
                                                std::exp(n * std::log1p(-static_cast<long double>(x))));
      const double tolerance = 32 * 0x1p-24 + n * std::sqrt(2 * x) * 0x1p-23;
      const double value = double{Phong<true>(material).eval(wo, wi).g};
      count(outcome, std::abs(value / expected - 1) < tolerance);
    }
  }
  return outcome;
}

/// 20: what is drawn, against 1 - (1 - u)^(1 / (n + 1)) in long double: log1p and expm1 err by a unit in the
/// last place, 2^-23, each, n + 1 and the division by half of it. In the direction x moves by as much again,
/// and by the rounding of unit vectors times |d| as above, for each of the terms that a direction is the sum
/// of.
Outcome sampled_exponents(std::string_view) {
  Outcome outcome;
  const Vec3 wo = direction(35), mirror(-wo.x, -wo.y, wo.z);
  const AboutAxis about(mirror);
  for (const float n : {0.0f, 1.0f, 100.0f, 1e4f, 1e5f, 1e6f}) {
    const PhongLobe<false> lobe(wo, n);
    for (std::uint32_t bits = 1; bits < 1u << 24; bits += 4999) {
      const float u = static_cast<float>(bits) * 0x1p-24f;
      const auto expected =
          static_cast<double>(-std::expm1(std::log1p(-static_cast<long double>(u)) / (n + 1.0L)));
      const double x = sample_one_minus_cos(n, u);
      count(outcome, std::abs(x / expected - 1) <= 6 * 0x1p-24);
      const double length = std::sqrt(2 * expected);
      count(outcome, std::abs(about.one_minus_cos(lobe.sample({u, 0.3f})) - expected) <
                         0x1p-24 * (12 * expected + 8 * length));
    }
  }
  return outcome;
}

/// 24: the smallest and largest random numbers, in every sampling of the BRDF.
Outcome extreme_numbers(std::string_view) {
  Outcome outcome;
  constexpr float last = 1 - 0x1p-24f;
  for (const BrdfOptions& options : kBrdfs) {
    for (const float n : {0.0f, 1.0f, 5000.0f, 1e6f}) {
      const Material material = make_material({0.3f, 0.3f, 0.3f}, {0.5f, 0.5f, 0.5f}, n, options);
      for (const Vec2& u : {Vec2(0, 0), Vec2(last, 0), Vec2(0, last), Vec2(last, last)}) {
        for (const float choice : {0.0f, last}) {
          for (const double angle : {0.0, 60.0, 89.99, 89.99999}) {
            const auto s = Phong<true>(material).sample(direction(angle), choice, u);
            const bool right = !s || (is_finite(s->wi) && std::abs(length(s->wi) - 1) <= 4 * 0x1p-23 &&
                                      std::isfinite(s->pdf.value) && s->pdf.value > 0 &&
                                      std::isfinite(s->weight.g) && s->weight.g >= 0);
            count(outcome, right);
          }
        }
      }
    }
  }
  return outcome;
}

/// 25: a pixel of 1e7 samples, 1e6 and 1e-3 in turns, to 1e-12: 1e-3 is less than a unit in the last place of
/// the sum, which without what additions round off errs by 1e-10; a sum in float would stop to grow.
Outcome many_samples(std::string_view) {
  constexpr int pairs = 5'000'000;
  PixelSum sum;
  for (int i = 0; i < pairs; ++i) {
    sum.add({1e6f, 1e-3f, 1});
    sum.add({1e-3f, 1e6f, 1});
  }
  const long double expected = pairs * (1e6L + static_cast<long double>(1e-3f));
  Outcome outcome;
  count(outcome, std::abs(static_cast<double>(sum.r / expected - 1)) < 1e-12);
  count(outcome, std::abs(static_cast<double>(sum.g / expected - 1)) < 1e-12);
  count(outcome, sum.b == 2.0 * pairs);
  return outcome;
}

/// 22: a box that emits 1 and reflects a, all of whose walls are seen by all others: 1 / (1 - a) everywhere.
Scene closed_box(float albedo) {
  Scene scene;
  scene.view = {{0.2f, 0.3f, 0.4f}, {0.9f, 0.6f, 0.5f}, {0, 1, 0}, 60, 8, 8};
  scene.triangles = inward_box({-1, -1, -1}, {1, 1, 2});
  scene.materials = {make_material({albedo, albedo, albedo}, {}, 1)};
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    scene.facets.push_back({0, i});
    scene.emitters.push_back({.shape = scene.triangles[i], .radiance = {1, 1, 1}, .triangle = i});
  }
  scene.needs.lights = 1;
  scene.needs.emitter_triangles = scene.emitters.size();
  return scene;
}

/// Means within 5 standard errors of 16 seeds: exceeded by chance in one of 6000 comparisons.
Outcome furnace(std::string_view backend) {
  Outcome outcome;
  for (const float albedo : {0.5f, 0.9f}) {
    for (const char* integrator : {"mis", "brdf", "mis-report"}) {
      for (const Roulette roulette : {Roulette::throughput, Roulette::fixed}) {
        if (has_infinite_variance(roulette, albedo, kTwoSampleSpread)) continue;
        const IntegratorOptions options{.roulette = roulette, .emitters_reflect = true};
        const Estimate e =
            mean_over_seeds(closed_box(albedo), {backend, integrator, "tree", options}, 16, 0, 16);
        count(outcome, std::abs(e.mean - 1 / (1 - double{albedo})) < 5 * e.standard_error + 1e-5);
      }
    }
  }
  return outcome;
}

}  // namespace

std::span<const HardCase> estimator_cases() {
  static constexpr HardCase cases[] = {
      {"20 exponents 0 to 1e6", "the formula's digits", exponent_ladder},
      {"20 samples of exponents 0 to 1e6", "the formula's digits", sampled_exponents},
      {"24 extremes of random numbers, BRDFs", "finite directions", extreme_numbers},
      {"25 a pixel of 1e7 samples", "the sum to 1e-12", many_samples}};
  return cases;
}

std::span<const HardCase> furnace_cases() {
  static constexpr HardCase cases[] = {
      {"22 closed box, albedo 0.5 and 0.9", "radiance 2 and 10", furnace, true}};
  return cases;
}

}  // namespace lemma::test
