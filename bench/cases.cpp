#include "bench/cases.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "bench/meshes.h"
#include "src/core/error_bound.h"
#include "src/core/frame.h"
#include "src/core/sampler.h"
#include "src/core/warp.h"
#include "src/scene/load_scene.h"

namespace lemma::bench {
namespace {

constexpr int kBatch = 16;

constexpr const char* kRealScenes = "LEMMA_REAL_SCENES";  // a folder with the course's staircase
constexpr const char* kStaircase = "staircase";

Case scene_case(const std::filesystem::path& path) {
  Scene scene = load_scene(path).scene;
  Case result{std::move(scene.triangles), scene.view, {}};
  for (const Emitter& e : scene.emitters) result.lights.push_back(e.shape);
  return result;
}

/// "1000", "16k", "4M".
std::size_t parse_count(const std::string& text) {
  std::size_t count = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const std::string_view unit(rest, text.data() + text.size());
  if (error != std::errc{} || !(unit.empty() || unit == "k" || unit == "M"))
    throw std::runtime_error(fmt::format("\"{}\" is no number of triangles; try 1000, 16k or 4M", text));
  return count * (unit == "k" ? 1000 : unit == "M" ? 1000000 : 1);
}

/// The way from x to a point of one of the lights, all of which are as likely; none if it shows x its back.
std::optional<Vec3> way_to_light(const std::vector<Triangle>& lights, const Vec3& x, Sampler& random) {
  const auto i = (static_cast<std::uint64_t>(random.next_bits()) * lights.size()) >> 32;
  const Triangle& light = lights[static_cast<std::size_t>(i)];
  const auto [b1, b2] = uniform_triangle(random.next_2d());
  const Vec3 way = Vec3(point_at(light, b1, b2)) - x;
  if (dot(Vec3d(way), area_vector(light)) >= 0) return std::nullopt;
  return way;
}

void add_secondary_rays(const Case& scene, const Ray& ray, const Hit& hit, Sampler& random,
                        RecordedRays& rays) {
  const Triangle& t = scene.triangles[hit.triangle];
  Vec3d normal = normalize(area_vector(t));
  if (dot(normal, Vec3d(ray.direction)) > 0) normal = -normal;
  const Vec3 origin = offset_origin(point_at(t, hit.b1, hit.b2), normal, t);
  rays.bounce.push_back({origin, frame_around(Vec3(normal)).to_world(cosine_hemisphere(random.next_2d()))});
  const auto way = way_to_light(scene.lights, origin, random);
  if (way && dot(Vec3d(*way), normal) > 0) rays.shadow.push_back({origin, *way, 0, 0.999f});
}

}  // namespace

std::vector<std::string> case_names() {
  std::vector<std::string> names{"veach-mis", "interior", "sphere-1M", "field-1M"};
  if (std::getenv(kRealScenes) != nullptr) names.insert(names.begin() + 2, kStaircase);
  return names;
}

std::vector<std::string> growth_names() {
  std::vector<std::string> names;
  for (const char* mesh : {"sphere", "field"}) {
    for (const char* count : {"1k", "4k", "16k", "64k", "250k", "1M", "4M"})
      names.push_back(fmt::format("{}-{}", mesh, count));
  }
  return names;
}

Case make_case(const std::string& name) {
  if (name == "veach-mis") return scene_case(std::filesystem::path(LEMMA_SCENES) / name);
  if (name == "interior")
    return {interior(), {{0.6f, 1.7f, 2}, {8, 1, 4.5f}, {0, 1, 0}, 55}, lamp({6, 4.9f, 4}, 0.5f)};
  if (name.starts_with("sphere-"))
    return {displaced_sphere_in_box(parse_count(name.substr(7))),
            {{1.2f, 0.9f, 1.6f}, {0, 0, 0}, {0, 1, 0}, 60},
            lamp({0, 1.9f, 0}, 0.5f)};
  if (name.starts_with("field-"))
    return {height_field(parse_count(name.substr(6))),
            {{1, 0.7f, 1.2f}, {0, 0, 0}, {0, 1, 0}, 60},
            lamp({0, 0.8f, 0}, 0.3f)};
  const char* real_scenes = std::getenv(kRealScenes);
  if (name == kStaircase && real_scenes != nullptr)
    return scene_case(std::filesystem::path(real_scenes) / "zju-2022-staircase");
  return scene_case(name);
}

RecordedRays record_rays(const Case& scene, const Accelerator& accel, const RaySize& size) {
  CameraView view = scene.view;
  view.width = size.width;
  view.height = size.height;
  const Camera camera(view);
  RecordedRays rays;
  for (int tile_y = 0; tile_y < size.height; tile_y += kBatch) {
    for (int tile_x = 0; tile_x < size.width; tile_x += kBatch) {
      for (int y = tile_y; y < std::min(tile_y + kBatch, size.height); ++y) {
        for (int x = tile_x; x < tile_x + kBatch; ++x) {
          Sampler random(1, static_cast<std::uint32_t>(y * size.width + x), 0);
          const Vec2 u = random.next_2d();
          const Ray ray = camera.ray_through(static_cast<float>(x) + u.x, static_cast<float>(y) + u.y);
          rays.primary.push_back(ray);
          if (const auto hit = accel.closest_hit(ray)) add_secondary_rays(scene, ray, *hit, random, rays);
        }
      }
    }
  }
  return rays;
}

std::span<const Named<RayKind>> ray_kinds() {
  static constexpr Named<RayKind> table[] = {
      {"primary", {&RecordedRays::primary, false, Asked::single}, "camera rays, one by one"},
      {"bounce", {&RecordedRays::bounce, false, Asked::single}, "cosine-distributed rays from surfaces"},
      {"shadow", {&RecordedRays::shadow, true, Asked::single}, "any hit between surfaces and lights"},
      {"primary-batch",
       {&RecordedRays::primary, false, Asked::rows},
       "camera rays, a wave of rows of 16 at a time"},
      {"bounce-wave",
       {&RecordedRays::bounce, false, Asked::wave},
       "cosine-distributed rays, a wave at a time"},
      {"shadow-wave", {&RecordedRays::shadow, true, Asked::wave}, "any hit, a wave at a time"}};
  return table;
}

namespace {

/// Putting the rays into the wave counts as well.
void trace_waves(const Accelerator& accel, std::span<const Ray> rays, bool any_hit, Coherence coherence) {
  RayWave wave;
  HitWave hits;
  Wave<std::uint8_t> blocked;
  for (std::size_t begin = 0; begin < rays.size(); begin += kWaveSize) {
    const std::size_t count = std::min(kWaveSize, rays.size() - begin);
    for (std::size_t i = 0; i < count; ++i) wave.set(i, rays[begin + i]);
    if (any_hit) {
      accel.occluded_rays(wave, count, blocked);
    } else {
      accel.closest_hits(wave, count, coherence, hits);
    }
    benchmark::DoNotOptimize(blocked);
    benchmark::DoNotOptimize(hits);
  }
}

void trace_single(const Accelerator& accel, std::span<const Ray> rays, bool any_hit) {
  for (const Ray& ray : rays) {
    if (any_hit) {
      benchmark::DoNotOptimize(accel.occluded(ray));
    } else {
      benchmark::DoNotOptimize(accel.closest_hit(ray));
    }
  }
}

}  // namespace

void trace(const Accelerator& accel, const RecordedRays& recorded, const RayKind& kind) {
  const std::span<const Ray> rays = recorded.*kind.rays;
  switch (kind.asked) {
    case Asked::single:
      return trace_single(accel, rays, kind.any_hit);
    case Asked::rows:
      return trace_waves(accel, rays, kind.any_hit, Coherence::steps);
    case Asked::wave:
      return trace_waves(accel, rays, kind.any_hit, Coherence::none);
  }
}

}  // namespace lemma::bench
