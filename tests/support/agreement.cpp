#include "tests/support/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

#include "src/core/parallel.h"

namespace lemma::test {
namespace {

constexpr int kSeeds = 32;
constexpr int kBlock = 8;

/// Means of a run over its seeds: of the image first, then of its blocks.
std::vector<Estimate> means(const Scene& scene, const Run& run, std::uint64_t first_seed) {
  const Configuration& c = run.configuration;
  const auto accel = find_named(accelerators(), c.accel).value()(scene.triangles, {});
  const auto lights = find_named(light_samplers(), c.lights).value()(scene.emitters);
  const auto integrator = find_named(integrators(), c.integrator).value()(scene.needs.model, c.options);
  std::vector<std::vector<double>> values(kSeeds);
  std::vector<std::uint64_t> invalid(kSeeds);
  parallel_for(kSeeds, [&](std::size_t i) {
    const RenderResult result =
        render({scene, *accel, *lights}, *integrator,
               {.spp = run.spp, .seed = first_seed + i, .sequence = c.sequence}, nullptr);
    invalid[i] = result.invalid_samples;
    values[i] = block_means(result.image, kBlock);
    values[i].insert(values[i].begin(), image_mean(result.image));
  });
  for (const std::uint64_t count : invalid) EXPECT_EQ(count, 0u) << "invalid samples";
  std::vector<Estimate> estimates;
  for (std::size_t b = 0; b < values.front().size(); ++b) {
    std::vector<double> of_seeds;
    for (const auto& v : values) of_seeds.push_back(v[b]);
    estimates.push_back(estimate(of_seeds));
  }
  return estimates;
}

/// Means of a run, with as many samples as wanted_bias() takes. Those of the first rendering decide that and
/// nothing else, so that the test of the others is not biased by it.
std::vector<Estimate> precise_means(const Scene& scene, Run run, double limit, std::uint64_t& first_seed) {
  const auto next_means = [&] { return means(scene, run, std::exchange(first_seed, first_seed + kSeeds)); };
  std::vector<Estimate> found = next_means();
  if (const auto bias = wanted_bias()) {
    // The difference of two means of equal noise errs by sqrt(2) of it.
    const double noise = limit * std::sqrt(2) * found[0].standard_error / found[0].mean;
    const double effort = std::clamp(std::pow(noise / *bias, 2), 1.0, kMostEffort);
    run.spp = static_cast<std::uint32_t>(std::ceil(run.spp * effort));
    found = next_means();
  }
  return found;
}

std::string name_of(const Configuration& c) {
  std::string name(c.accel);
  for (const std::string_view part : {c.integrator, c.lights}) name.append(1, ' ').append(part);
  if (c.options.heuristic == Heuristic::balance) name += " balance-heuristic";
  if (c.options.roulette == Roulette::fixed) name += " fixed";
  if (c.sequence == Sequence::independent) name += " independent";
  return name;
}

}  // namespace

std::optional<double> wanted_bias() {
  const char* percent = std::getenv("LEMMA_AGREEMENT");
  if (percent == nullptr) return std::nullopt;
  const double bias = std::strtod(percent, nullptr) / 100;
  if (!(bias > 0)) throw std::invalid_argument("LEMMA_AGREEMENT is no percentage above 0");
  return bias;
}

void expect_equal_means(const Scene& scene, std::vector<Run> runs) {
  const int others = static_cast<int>(runs.size()) - 1;
  const double limit = t_limit(kFalseAlarm / 2, others, kSeeds - 1);
  std::vector<Estimate> reference;
  std::uint64_t first_seed = 0;
  double largest_seen = 0;
  for (const Run& run : runs) {
    const std::vector<Estimate> found = precise_means(scene, run, limit, first_seed);
    const std::string name = name_of(run.configuration);
    if (reference.empty()) {
      reference = found;
      std::printf("%-48s mean %.6f +- %.6f\n", name.c_str(), found[0].mean, found[0].standard_error);
      continue;
    }
    const int blocks = static_cast<int>(found.size()) - 1;
    const double block_limit = t_limit(kFalseAlarm / 2, others * blocks, kSeeds - 1);
    const double z = z_score(found[0], reference[0]);
    double largest = 0;
    for (std::size_t b = 1; b < found.size(); ++b) {
      largest = std::max(largest, std::abs(z_score(found[b], reference[b])));
    }
    const double seen =
        limit * std::hypot(found[0].standard_error, reference[0].standard_error) / reference[0].mean;
    largest_seen = std::max(largest_seen, seen);
    std::printf("%-48s mean %.6f +- %.6f  t %5.2f  blocks %4.2f  sees %.3f %%\n", name.c_str(), found[0].mean,
                found[0].standard_error, z, largest, 100 * seen);
    EXPECT_LT(std::abs(z), limit) << name;
    EXPECT_LT(largest, block_limit) << name;
    // What a comparison cannot see must be small, or it shows nothing.
    EXPECT_LT(seen, kUsualBias) << name << " is too noisy to see a bias";
  }
  std::printf("%d comparisons of images: |t| below %.2f; all see %.3f %% or less\n", others, limit,
              100 * largest_seen);
}

std::vector<Run> all_estimators(std::uint32_t spp) {
  IntegratorOptions squared, balance, fixed;
  balance.heuristic = Heuristic::balance;
  fixed.roulette = Roulette::fixed;
  constexpr std::string_view strategies[] = {"tree", "solid-angle", "projected", "power", "radiance-area"};
  const auto samples = [&](std::string_view lights) {
    return lights == "power" ? 2 * spp : lights == "radiance-area" ? 4 * spp : spp;
  };
  std::vector<Run> runs{{{"embree", "mis", "tree"}, 4 * spp}};
  const auto add = [&](const Configuration& c, std::uint32_t count) { runs.push_back({c, count}); };
  if (wanted_bias()) {
    for (const std::string_view lights : strategies) {
      for (const std::string_view accel : {"embree", "grid"}) {
        for (const Sequence sequence : {Sequence::sobol, Sequence::independent}) {
          for (const auto& options : {squared, balance, fixed}) {
            add({accel, "mis", lights, options, sequence}, samples(lights));
          }
        }
      }
    }
  } else {
    for (const std::string_view lights : strategies) {
      if (lights != "tree") add({"embree", "mis", lights}, samples(lights));
      add({"embree", "mis", lights, balance}, samples(lights));
    }
    add({"grid", "mis", "tree"}, spp);
    add({"grid", "mis", "power", balance, Sequence::independent}, 4 * spp);
    add({"embree", "mis", "tree", squared, Sequence::independent}, 4 * spp);
    add({"embree", "mis", "tree", fixed}, spp);
  }
  add({"embree", "direct", "tree"}, 2 * spp);
  add({"embree", "direct", "solid-angle"}, 2 * spp);
  add({"embree", "direct", "projected"}, 2 * spp);
  add({"embree", "direct", "power"}, 8 * spp);
  add({"embree", "direct", "power", fixed}, 8 * spp);
  add({"embree", "brdf", "tree"}, 8 * spp);
  add({"embree", "mis-report", "tree"}, 2 * spp);
  add({"embree", "mis-report", "power", squared}, 4 * spp);
  return runs;
}

}  // namespace lemma::test
