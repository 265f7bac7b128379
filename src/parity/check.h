#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/oracle/oracle.h"
#include "src/parity/ray_kinds.h"

namespace lemma {

/// A backend to check.
struct Contestant {
  std::string_view name;
  const Accelerator* accel = nullptr;
  std::uint32_t stride = 1;  // it is asked one of so many rays: brute force takes long
};

/// What the rays of one kind were, and how a backend answered them.
struct Tally {
  std::uint64_t rays = 0, decided = 0;
  std::array<std::uint64_t, kDoubts> ambiguous{};  // by reason
  std::uint64_t wrong = 0, missed = 0;             // answers of closest_hit; see Verdict
  std::uint64_t wrong_occlusion = 0;  // answers of occluded() that cannot be, or differ from closest_hit's
  double distance_error = 0;          // largest error of t on decided rays, in units of its bound

  Tally& operator+=(const Tally& o);
  [[nodiscard]] std::uint64_t faults() const { return wrong + missed + wrong_occlusion; }
};

/// An answer that cannot be.
struct Fault {
  RayKind kind = RayKind::camera;
  Ray ray;
  std::string_view what;      // "wrong", "missed" or "occlusion"
  std::optional<Hit> answer;  // of closest_hit
  bool occluded = false;      // answer of occluded()
  std::optional<ExactHit> truth;
};

/// How one backend did.
struct Record {
  std::string_view name;
  std::array<Tally, kRayKinds> kinds{};
  std::vector<Fault> first_faults{};  // some of them, in the order of the rays

  static constexpr std::size_t kReportedFaults = 10;
  [[nodiscard]] Tally total() const;
};

/// Called now and then from any thread with the part done, in [0, 1]; never from two threads at a time.
using CheckProgress = std::function<void(double)>;

/// Asks every contestant about the rays 0 to count - 1 of the source, closest hit and occlusion, half of them
/// as waves, and judges the answers by the oracle. The records are the same whatever the threads.
[[nodiscard]] std::vector<Record> check_parity(const Oracle& oracle, const RaySource& source,
                                               std::span<const Contestant> contestants, std::uint32_t count,
                                               const CheckProgress& progress);

}  // namespace lemma
