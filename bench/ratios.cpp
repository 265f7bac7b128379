#include "bench/ratios.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/cases.h"

namespace lemma::bench {
namespace {

template <class Action>
double seconds(const Action& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Medians over rounds A B A B ... of the two times and of their quotient.
struct Comparison {
  double grid, embree, speed;  // [s], [s], embree / grid
};

/// Time that the calling thread was running: what else the machine does takes turns with it, and does not
/// count.
template <class Action>
double cpu_seconds(const Action& action) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  action();
  return now() - start;
}

template <class Measure>
Comparison compare(int rounds, const Measure& measure) {
  std::vector<double> grid, embree, speed;
  for (int i = 0; i < rounds; ++i) {
    grid.push_back(measure("grid"));
    embree.push_back(measure("embree"));
    speed.push_back(embree.back() / grid.back());
  }
  return {median(grid), median(embree), median(speed)};
}

std::unique_ptr<const Accelerator> build(std::string_view accel, const Case& scene) {
  return find_named(accelerators(), accel).value()(scene.triangles, {});
}

/// The kinds of the geometric mean: one ray at a time.
bool counts(const Named<RayKind>& kind) {
  return kind.value.asked == Asked::single;
}

/// One case: its line of the table and its JSON; multiplies its ratios into the geometric mean.
nlohmann::json compare_case(const std::string& name, int rounds, double& log_sum, int& terms) {
  const Case scene = make_case(name);
  const auto triangles = static_cast<double>(scene.triangles.size());
  const auto grid = build("grid", scene), embree = build("embree", scene);
  const RecordedRays rays = record_rays(scene, *embree);
  const double bytes = static_cast<double>(grid->memory_bytes()) / triangles;
  nlohmann::json json{
      {"case", name}, {"triangles", scene.triangles.size()}, {"grid_bytes_per_triangle", bytes}};
  fmt::print("{:<14} {:>9} {:>8.0f}", name, scene.triangles.size(), bytes);
  const Comparison built =
      compare(3, [&](std::string_view accel) { return seconds([&] { build(accel, scene); }); });
  json["build"] = {{"grid_s", built.grid}, {"embree_s", built.embree}, {"ratio", built.speed}};
  fmt::print(" {:>7.2f}", built.speed);
  for (const Named<RayKind>& kind : ray_kinds()) {
    const Comparison traced = compare(rounds, [&](std::string_view accel) {
      return cpu_seconds([&] { trace(accel == "grid" ? *grid : *embree, rays, kind.value); });
    });
    const auto count = static_cast<double>((rays.*kind.value.rays).size());
    json["trace"][std::string(kind.name)] = {{"grid_rays_per_s", count / traced.grid},
                                             {"embree_rays_per_s", count / traced.embree},
                                             {"ratio", traced.speed}};
    fmt::print(" {:>5.2f} ({:>4.2f}/{:>5.2f})", traced.speed, count / traced.grid * 1e-6,
               count / traced.embree * 1e-6);
    if (counts(kind)) log_sum += std::log(traced.speed), ++terms;
  }
  fmt::print("   {}\n", grid->description());
  return json;
}

}  // namespace

void print_ratios(const std::vector<std::string>& cases, int rounds, const std::string& json_file) {
  fmt::print("Speed of grid / speed of embree; in brackets millions of rays per second of both.\n");
  fmt::print("{:<14} {:>9} {:>8} {:>7}", "case", "triangles", "B/tri", "build");
  for (const Named<RayKind>& kind : ray_kinds()) fmt::print(" {:<18}", kind.name);
  fmt::print("\n");
  nlohmann::json json;
  double log_sum = 0;
  int terms = 0;
  for (const std::string& name : cases) {
    json["cases"].push_back(compare_case(name, rounds, log_sum, terms));
    std::fflush(stdout);
  }
  json["geometric_mean"] = std::exp(log_sum / terms);
  fmt::print("geometric mean of primary, bounce and shadow over {} cases: {:.2f}\n", cases.size(),
             std::exp(log_sum / terms));
  if (!json_file.empty()) std::ofstream(json_file) << json.dump(2) << '\n';
}

}  // namespace lemma::bench
