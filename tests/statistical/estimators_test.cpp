#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/support/hemisphere.h"
#include "tests/support/images.h"
#include "tests/support/meshes.h"

namespace lemma {
namespace {

using test::Estimate;

// All {BRDF sampling} x {roulette} x {random numbers} x {integrator}, with either weight where there are
// weights, against a longer rendering of `mis` with seeds of its own: image means, means of blocks, and means
// over all estimators that share a part, which see a smaller bias of that part.

constexpr int kEdge = 16, kBlock = 4, kBlocks = (kEdge / kBlock) * (kEdge / kBlock);  // [pixels]
constexpr int kSeeds = 32;
constexpr int kReferenceWork = 48;  // samples of the reference, as a multiple of an estimator's

/// Chance that any comparison of a test fails although all estimators have the same mean; half of it for the
/// means of images and parts, half for those of blocks. Seeds are fixed: a test that passes does so always.
constexpr double kFalseAlarm = 1e-3;

/// A room that light cannot leave, whose ceiling emits; a panel that emits hangs below it, so that directions
/// meet two lights, and a ball hides both from parts of the floor. Lobes from wide ones, which the horizon
/// cuts, to sharp ones; the largest albedo is 0.65, below sqrt(0.6).
Scene glossy_room(const BrdfOptions& brdf) {
  Scene scene;
  scene.view = {{0.1f, 0.2f, 2.8f}, {0, -0.3f, 0}, {0, 1, 0}, 60, kEdge, kEdge};
  const auto grey = [&](float kd, float ks, float n) {
    return make_material({kd, kd, kd}, {ks, ks, ks}, n, brdf);
  };
  scene.materials = {grey(0.4f, 0.2f, 30), grey(0.2f, 0.45f, 3), grey(0.1f, 0.5f, 100), grey(0, 0.6f, 0)};
  const auto add = [&](const Triangle& t, std::uint32_t material) {
    scene.triangles.push_back(t);
    scene.facets.push_back({material, kNoEmitter});
  };
  const auto add_emitter = [&](const Triangle& t, float radiance, std::uint32_t light) {
    add(t, 0);
    scene.facets.back().emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({.shape = t,
                              .radiance = {radiance, radiance, radiance},
                              .triangle = static_cast<std::uint32_t>(scene.triangles.size() - 1),
                              .light = light});
  };
  for (const Triangle& t : test::inward_box({-1, -1, -1}, {1, 1, 3})) {
    const Vec3 n(area_vector(t));
    if (n.y < 0) {
      add_emitter(t, 1, 0);  // the ceiling
    } else {
      add(t, n.y > 0 ? 1 : n.x != 0 ? 2 : 0);
    }
  }
  const Vec3 corner(-0.4f, 0.6f, -0.4f), x(0.7f, 0, 0), z(0, 0, 0.9f);
  add_emitter({corner, corner + x, corner + z}, 3, 1);
  add_emitter({corner + x, corner + x + z, corner + z}, 3, 1);
  for (const Triangle& t : test::sphere_mesh({0.3f, -0.6f, 0.2f}, 0.35f, 6, 10)) add(t, 3);
  scene.overlays = find_overlays(scene.triangles, scene.emitters);
  scene.needs.model.overlays = !scene.overlays.empty();
  scene.needs.model.specular = true;
  scene.needs.lights = 2;
  scene.needs.emitter_triangles = scene.emitters.size();
  return scene;
}

/// Means of the whole image, first, and of its blocks.
using Means = std::vector<double>;

Means means_of(const Image& image) {
  Means means{test::image_mean(image)};
  for (int top = 0; top < kEdge; top += kBlock) {
    for (int left = 0; left < kEdge; left += kBlock) {
      double sum = 0;
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) sum += image.at(left + x, top + y).g;
      }
      means.push_back(sum / (kBlock * kBlock));
    }
  }
  return means;
}

struct Estimator {
  LobeSampling sampling = LobeSampling::truncated;
  test::Configuration configuration;

  /// The names of its parts.
  [[nodiscard]] std::vector<std::string> parts() const {
    const auto& [accel, integrator, lights, options, sequence] = configuration;
    std::vector<std::string> names{std::string(integrator), std::string(name_of(lobe_samplings(), sampling)),
                                   std::string(name_of(roulettes(), options.roulette)),
                                   std::string(name_of(sequences(), sequence))};
    if (integrator.starts_with("mis")) {
      names.push_back("weights: " + std::string(name_of(heuristics(), options.heuristic)));
    }
    return names;
  }
};

std::vector<Estimator> all_estimators(Lobe lobe) {
  std::vector<Estimator> all;
  for (const auto& integrator : integrators()) {
    for (const auto& heuristic : heuristics()) {
      if (heuristic.value != IntegratorOptions().heuristic && !integrator.name.starts_with("mis")) continue;
      for (const auto& sampling : lobe_samplings()) {
        // The choice is the Phong lobe's alone.
        if (lobe == Lobe::blinn_phong && sampling.value != LobeSampling::truncated) continue;
        for (const auto& roulette : roulettes()) {
          for (const auto& sequence : sequences()) {
            if (lobe == Lobe::blinn_phong && sequence.value != Sequence::sobol) continue;
            all.push_back({sampling.value,
                           {"embree",
                            integrator.name,
                            "tree",
                            {.roulette = roulette.value, .heuristic = heuristic.value},
                            sequence.value}});
          }
        }
      }
    }
  }
  return all;
}

/// Estimates of all means from kSeeds renderings.
std::vector<Estimate> render_means(const Scene& scene, const test::Configuration& c, std::uint32_t spp,
                                   std::uint64_t first_seed) {
  std::vector<std::vector<double>> values(1 + kBlocks);
  for (int i = 0; i < kSeeds; ++i) {
    const RenderResult result = test::render_scene(
        scene, c, {.spp = spp, .seed = first_seed + static_cast<std::uint64_t>(i), .sequence = c.sequence});
    EXPECT_EQ(result.invalid_samples, 0u);
    const Means means = means_of(result.image);
    for (std::size_t k = 0; k < means.size(); ++k) values[k].push_back(means[k]);
  }
  std::vector<Estimate> estimates;
  for (const auto& v : values) estimates.push_back(test::estimate(v));
  return estimates;
}

/// Differences to the reference, summed over the estimators that share a part.
struct PartSum {
  double difference = 0, variance = 0;
  int count = 0;
};

/// @param part_bias  of a part shared by several estimators, that is found at least [of the mean]
void expect_equal_means(Lobe lobe, std::uint32_t spp, double part_bias) {
  const auto scene_of = [&](LobeSampling sampling) {
    return glossy_room({.lobe = lobe, .sampling = sampling});
  };
  const std::map<LobeSampling, Scene> scenes{{LobeSampling::truncated, scene_of(LobeSampling::truncated)},
                                             {LobeSampling::p6, scene_of(LobeSampling::p6)}};
  const auto estimators = all_estimators(lobe);
  const auto reference =
      render_means(scenes.at(LobeSampling::truncated), {"embree", "mis", "tree"}, kReferenceWork * spp, 1);
  std::map<std::string, PartSum> parts;
  for (const Estimator& e : estimators) {
    for (const std::string& part : e.parts()) ++parts[part].count;
  }
  const auto image_tests = static_cast<int>(estimators.size() + parts.size());
  const auto block_tests = static_cast<int>(estimators.size()) * kBlocks;
  const double limit = test::t_limit(kFalseAlarm / 2, image_tests, kSeeds - 1),
               block_limit = test::t_limit(kFalseAlarm / 2, block_tests, kSeeds - 1);

  std::uint64_t seed = 1000;
  double largest_error = 0;
  for (const Estimator& e : estimators) {
    const std::string_view integrator = e.configuration.integrator;
    const std::uint32_t work = integrator == "direct" ? 4 : integrator == "brdf" ? 2 : 1;  // for equal noise
    const auto means = render_means(scenes.at(e.sampling), e.configuration, work * spp, seed += kSeeds);
    std::string name;
    for (const std::string& part : e.parts()) {
      name += part + " ";
      parts[part].difference += means[0].mean - reference[0].mean;
      parts[part].variance += means[0].standard_error * means[0].standard_error;
    }
    double worst = 0;
    for (std::size_t k = 1; k < means.size(); ++k) {
      worst = std::max(worst, std::abs(test::z_score(means[k], reference[k])));
    }
    const double z = test::z_score(means[0], reference[0]);
    std::printf("%-58s %.6f +- %.6f  z %5.2f  worst block %4.2f\n", name.c_str(), means[0].mean,
                means[0].standard_error, z, worst);
    EXPECT_LT(std::abs(z), limit) << name;
    EXPECT_LT(worst, block_limit) << name;
    largest_error = std::max(largest_error, means[0].standard_error);
  }
  double largest_part_error = 0;
  for (const auto& [part, sum] : parts) {
    const double error = std::hypot(std::sqrt(sum.variance) / sum.count, reference[0].standard_error);
    const double z = sum.difference / sum.count / error;
    std::printf("all of %-20s (%2d): %.6f +- %.6f  z %5.2f\n", part.c_str(), sum.count,
                reference[0].mean + sum.difference / sum.count, error, z);
    EXPECT_LT(std::abs(z), limit) << part;
    largest_part_error = std::max(largest_part_error, error);
  }
  // What is beyond these is found, in one estimator or in a part of them.
  const double detectable = limit * largest_error / reference[0].mean,
               detectable_part = limit * largest_part_error / reference[0].mean;
  std::printf(
      "|z| below %.2f, of blocks %.2f; smallest bias that is found: %.2f %% of one estimator, %.2f %% of "
      "a part\n",
      limit, block_limit, 100 * detectable, 100 * detectable_part);
  EXPECT_LT(detectable, 0.02);
  EXPECT_LT(detectable_part, part_bias);
}

/// A plate in a box whose walls emit 1 and absorb: whatever leaves it is its directional albedo.
Scene plate_in_furnace(const Material& material, const Vec3& towards_camera) {
  Scene scene;
  scene.view = {towards_camera * 3.0f, {0, 0, 0}, {0, 0, -1}, 0.05f, 2, 2};
  scene.triangles = test::inward_box({-5, -5, -5}, {5, 5, 5});
  scene.materials = {material};
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    scene.facets.push_back({0, i});
    scene.emitters.push_back({.shape = scene.triangles[i], .radiance = {1, 1, 1}, .triangle = i});
  }
  scene.triangles.push_back({{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}});
  scene.triangles.push_back({{-1, 0, -1}, {1, 0, 1}, {1, 0, -1}});
  scene.facets.resize(scene.triangles.size());
  scene.needs.model.specular = true;
  return scene;
}

/// Directional albedo of Blinn's lobe for ks = 1, by quadrature over half vectors: dwi = 4 (wo . h) dh.
double blinn_albedo(float n, const Vec3& wo) {
  const Material material = make_material({}, {1, 1, 1}, n, {.lobe = Lobe::blinn_phong});
  return test::lobe_mean({0, 0, 1}, n, [&](const Vec3& h) {
    const float cos_h = dot(wo, h);
    const Vec3 wi = h * (2 * cos_h) - wo;
    if (cos_h <= 0 || wi.z <= 0) return 0.0;
    const double density = (n + 1) / (2 * M_PI) * std::pow(double{h.z}, double{n});
    return double{Phong<true>(material).eval(wo, wi).g} * wi.z * 4 * cos_h / density;
  });
}

/// Every BRDF with every integrator: kd + ks E(theta), E of the Phong lobe with n = 20 and the factor
/// (n + 1) / (2 pi) by quadrature in double, 5 digits.
TEST(Furnace, PlateReflectsItsDirectionalAlbedo) {
  constexpr float n = 20, kd = 0.25f, ks = 0.5f;
  constexpr std::pair<double, double> phong[] = {{0, .95455}, {60, .47776}, {85, .13201}};
  constexpr BrdfOptions brdfs[] = {{.sampling = LobeSampling::truncated},
                                   {.sampling = LobeSampling::p6},
                                   {.norm = PhongNorm::n_plus_2},
                                   {.lobe = Lobe::blinn_phong}};
  const auto cases = std::size(phong) * std::size(brdfs) * integrators().size();
  const double limit = test::t_limit(kFalseAlarm, static_cast<int>(cases), kSeeds - 1);
  for (const auto& [angle, lobe_albedo] : phong) {
    for (const BrdfOptions& brdf : brdfs) {
      const Vec3 local = test::direction(angle, 0), towards_camera(local.x, local.z, local.y);
      const double albedo = brdf.lobe == Lobe::blinn_phong     ? blinn_albedo(n, local)
                            : brdf.norm == PhongNorm::n_plus_2 ? lobe_albedo * (n + 2) / (n + 1)
                                                               : lobe_albedo;
      const double expected = kd + ks * albedo;
      const Scene scene =
          plate_in_furnace(make_material({kd, kd, kd}, {ks, ks, ks}, n, brdf), towards_camera);
      for (const auto& integrator : integrators()) {
        const std::uint32_t spp = integrator.name == "direct" ? 50 * 64 : 64;  // for about equal noise
        const Estimate e =
            test::mean_over_seeds(scene, {"grid", integrator.name, "solid-angle"}, spp, 0, kSeeds);
        EXPECT_NEAR(e.mean, expected, limit * e.standard_error + 5e-5)
            << integrator.name << ", " << angle << " degrees, " << name_of(lobes(), brdf.lobe);
        EXPECT_LT(limit * e.standard_error, 0.03 * expected);  // what is not seen
      }
    }
  }
}

TEST(Estimators, PhongHasOneMean) {
  expect_equal_means(Lobe::phong, 32, 0.006);
}

TEST(Estimators, BlinnPhongHasOneMean) {
  expect_equal_means(Lobe::blinn_phong, 48, 0.01);
}

}  // namespace
}  // namespace lemma
