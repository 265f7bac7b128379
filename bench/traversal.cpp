// How fast the accelerators build and trace.
//   traversal [Google Benchmark's options]       build/<accel>/<case>, trace/<accel>/<case>/<ray kind>
//   traversal --ratios [case...] [--growth] [--rounds=N] [--ratios-out=FILE.json]
//                                                grid against embree, measured in turns (ratios.h);
//                                                --growth: meshes from 1k to 4M triangles
//   traversal --embree-rate CASE                 rays a second of Embree alone, a unit of time
//   (embree_rate.h)
// A case is a built-in name (cases.h) or a scene's folder or file.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <stdexcept>

#include "bench/cases.h"
#include "bench/embree_rate.h"
#include "bench/ratios.h"

namespace lemma::bench {
namespace {

/// A case with what its benchmarks share. Made when first asked for: a filter leaves most cases out.
struct Prepared {
  Case scene;
  RecordedRays rays;
  std::map<std::string, std::unique_ptr<const Accelerator>, std::less<>> built;
};

Prepared& prepare(const std::string& name) {
  static std::string current;
  static Prepared prepared;  // of one case at a time: they are large
  if (name != current) {
    prepared = {make_case(name), {}, {}};
    for (const auto& accel : accelerators()) {
      if (accel.name != "brute")
        prepared.built[std::string(accel.name)] = accel.value(prepared.scene.triangles, {});
    }
    prepared.rays = record_rays(prepared.scene, *prepared.built.at("embree"));
    current = name;
  }
  return prepared;
}

void measure_build(benchmark::State& state, const std::string& name, AcceleratorFactory make) {
  const Case& scene = prepare(name).scene;
  for (auto _ : state) benchmark::DoNotOptimize(make(scene.triangles, {}));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.triangles.size()));
}

void measure_trace(benchmark::State& state, const std::string& name, const std::string& accel,
                   const RayKind& kind) {
  const Prepared& prepared = prepare(name);
  const Accelerator& built = *prepared.built.at(accel);
  for (auto _ : state) trace(built, prepared.rays, kind);
  const std::size_t rays = (prepared.rays.*kind.rays).size();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays));
  state.counters["bytes/triangle"] =
      static_cast<double>(built.memory_bytes()) / static_cast<double>(prepared.scene.triangles.size());
}

void register_case(const std::string& name) {
  for (const auto& accel : accelerators()) {
    if (accel.name == "brute") continue;
    benchmark::RegisterBenchmark(
        fmt::format("build/{}/{}", accel.name, name).c_str(),
        [name, make = accel.value](benchmark::State& state) { measure_build(state, name, make); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    for (const auto& kind : ray_kinds()) {
      benchmark::RegisterBenchmark(fmt::format("trace/{}/{}/{}", accel.name, name, kind.name).c_str(),
                                   [name, accel = std::string(accel.name), kind = kind.value](
                                       benchmark::State& state) { measure_trace(state, name, accel, kind); })
          ->Unit(benchmark::kMillisecond);
    }
  }
}

int run_benchmarks(int argc, char** argv) {
  std::vector<std::string> names = case_names();
  for (const std::string& name : growth_names()) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  for (const std::string& name : names) register_case(name);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

int run_ratios(const std::vector<std::string>& arguments) {
  std::vector<std::string> cases;
  int rounds = 9;
  std::string json_file;
  for (const std::string& argument : arguments) {
    if (argument.starts_with("--rounds=")) {
      rounds = std::max(std::stoi(argument.substr(9)), 1);
    } else if (argument.starts_with("--ratios-out=")) {
      json_file = argument.substr(13);
    } else if (argument == "--growth") {
      for (const std::string& name : growth_names()) cases.push_back(name);
    } else if (argument.starts_with("--")) {
      throw std::runtime_error(
          fmt::format("no option {}; there are --growth, --rounds=N and --ratios-out=FILE.json", argument));
    } else {
      cases.push_back(argument);
    }
  }
  if (cases.empty()) cases = case_names();
  print_ratios(cases, rounds, json_file);
  return 0;
}

}  // namespace
}  // namespace lemma::bench

int main(int argc, char** argv) {
  try {
    if (argc > 1 && std::string_view(argv[1]) == "--ratios")
      return lemma::bench::run_ratios({argv + 2, argv + argc});
    if (argc == 3 && std::string_view(argv[1]) == "--embree-rate") {
      fmt::print("{:.6g}\n", lemma::bench::embree_rate(argv[2]));
      return 0;
    }
    return lemma::bench::run_benchmarks(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "traversal: error: {}\n", e.what());
    return 1;
  }
}
