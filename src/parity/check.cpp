#include "src/parity/check.h"

#include <algorithm>
#include <mutex>

#include "src/core/parallel.h"

namespace lemma {
namespace {

constexpr std::uint32_t kRaysATask = 1000;  // a multiple of 20, the period of kinds
constexpr std::uint32_t kRaysAStride = 20;  // rays are left out by whole periods

/// The rays of one task with what the oracle says about them.
struct Questions {
  std::vector<std::uint32_t> indices;
  std::vector<Ray> rays;
  std::vector<Expectation> expected;
};

Questions make_questions(const Oracle& oracle, const RaySource& source, std::uint32_t begin,
                         std::uint32_t end) {
  Questions q;
  for (std::uint32_t i = begin; i < end; ++i) {
    q.indices.push_back(i);
    q.rays.push_back(source.draw(i));
    q.expected.push_back(oracle.expect(q.rays.back()));
  }
  return q;
}

struct Answers {
  std::vector<std::optional<Hit>> hits;
  std::vector<std::uint8_t> occluded;
};

/// @param waves  as waves of this coherence, but for rays that do not begin at their origins; else one by one
Answers ask(const Accelerator& accel, std::span<const Ray> rays, std::optional<Coherence> waves) {
  Answers a{std::vector<std::optional<Hit>>(rays.size()), std::vector<std::uint8_t>(rays.size())};
  std::vector<std::size_t> in_waves;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (waves && rays[i].t_min == 0) {
      in_waves.push_back(i);
    } else {
      a.hits[i] = accel.closest_hit(rays[i]);
      a.occluded[i] = accel.occluded(rays[i]) ? 1 : 0;
    }
  }
  RayWave wave;
  HitWave hits;
  Wave<std::uint8_t> occluded;
  for (std::size_t begin = 0; begin < in_waves.size(); begin += kWaveSize) {
    const auto lanes = std::span(in_waves).subspan(begin, std::min(kWaveSize, in_waves.size() - begin));
    for (std::size_t k = 0; k < lanes.size(); ++k) wave.set(k, rays[lanes[k]]);
    accel.closest_hits(wave, lanes.size(), *waves, hits);
    accel.occluded_rays(wave, lanes.size(), occluded);
    for (std::size_t k = 0; k < lanes.size(); ++k) {
      if (hits.is_hit(k)) a.hits[lanes[k]] = hits[k];
      a.occluded[lanes[k]] = occluded[k];
    }
  }
  return a;
}

/// How the rays of a task are asked for.
std::optional<Coherence> waves_of(std::size_t task) {
  if (task % 2 == 0) return std::nullopt;
  return task % 4 == 1 ? Coherence::none : Coherence::steps;
}

void count_ray(const Expectation& expected, Tally& tally) {
  ++tally.rays;
  if (expected.doubt) {
    ++tally.ambiguous[static_cast<std::size_t>(*expected.doubt)];
  } else {
    ++tally.decided;
  }
}

/// Judges one answer.
/// @return what is wrong with it; empty if nothing is
std::string_view judge(const Expectation& expected, const std::optional<Hit>& hit, bool occluded,
                       Tally& tally) {
  if (hit && !expected.doubt) {
    tally.distance_error = std::max(tally.distance_error, expected.distance_error(*hit));
  }
  const Verdict verdict = expected.judge(hit);
  if (verdict == Verdict::wrong) return ++tally.wrong, "wrong";
  if (verdict == Verdict::missed) return ++tally.missed, "missed";
  if (expected.judge_occlusion(occluded) != Verdict::right || occluded != hit.has_value()) {
    return ++tally.wrong_occlusion, "occlusion";
  }
  return {};
}

void add_fault(const Fault& fault, Record& record) {
  if (record.first_faults.size() < Record::kReportedFaults) record.first_faults.push_back(fault);
}

/// The part of a contestant's record that one task makes.
Record examine(const Contestant& contestant, const Questions& q, std::optional<Coherence> waves) {
  Record record{.name = contestant.name};
  std::vector<std::size_t> asked;
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < q.rays.size(); ++i) {
    if (q.indices[i] / kRaysAStride % contestant.stride != 0) continue;
    asked.push_back(i);
    rays.push_back(q.rays[i]);
  }
  const Answers answers = ask(*contestant.accel, rays, waves);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Expectation& expected = q.expected[asked[i]];
    const RayKind kind = kind_of(q.indices[asked[i]]);
    Tally& tally = record.kinds[static_cast<std::size_t>(kind)];
    count_ray(expected, tally);
    const bool occluded = answers.occluded[i] != 0;
    const std::string_view what = judge(expected, answers.hits[i], occluded, tally);
    if (!what.empty()) add_fault({kind, rays[i], what, answers.hits[i], occluded, expected.exact}, record);
  }
  return record;
}

void merge(const Record& part, Record& whole) {
  for (std::size_t k = 0; k < kRayKinds; ++k) whole.kinds[k] += part.kinds[k];
  for (const Fault& fault : part.first_faults) add_fault(fault, whole);
}

/// Passes on every new per cent.
class PerCent {
 public:
  PerCent(const CheckProgress& sink, std::size_t tasks) : sink_(sink), tasks_(tasks) {}

  void task_done() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (sink_ && 100 * done_ / tasks_ > 100 * (done_ - 1) / tasks_) {
      sink_(static_cast<double>(done_) / static_cast<double>(tasks_));
    }
  }

 private:
  const CheckProgress& sink_;
  std::size_t tasks_, done_ = 0;
  std::mutex mutex_;
};

}  // namespace

Tally& Tally::operator+=(const Tally& o) {
  rays += o.rays, decided += o.decided;
  for (std::size_t i = 0; i < kDoubts; ++i) ambiguous[i] += o.ambiguous[i];
  wrong += o.wrong, missed += o.missed, wrong_occlusion += o.wrong_occlusion;
  distance_error = std::max(distance_error, o.distance_error);
  return *this;
}

Tally Record::total() const {
  Tally total;
  for (const Tally& kind : kinds) total += kind;
  return total;
}

std::vector<Record> check_parity(const Oracle& oracle, const RaySource& source,
                                 std::span<const Contestant> contestants, std::uint32_t count,
                                 const CheckProgress& progress) {
  const std::uint32_t tasks = (count + kRaysATask - 1) / kRaysATask;
  std::vector<std::vector<Record>> parts(tasks);
  PerCent per_cent(progress, tasks);
  parallel_for(tasks, [&](std::size_t task) {
    const auto begin = static_cast<std::uint32_t>(task) * kRaysATask;
    const Questions q = make_questions(oracle, source, begin, std::min(count, begin + kRaysATask));
    for (const Contestant& c : contestants) parts[task].push_back(examine(c, q, waves_of(task)));
    per_cent.task_done();
  });
  std::vector<Record> records;
  for (const Contestant& c : contestants) records.push_back({.name = c.name});
  for (const std::vector<Record>& part : parts) {
    for (std::size_t c = 0; c < records.size(); ++c) merge(part[c], records[c]);
  }
  return records;
}

}  // namespace lemma
