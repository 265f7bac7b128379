#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "accel/accelerator.h"
#include "src/core/ray.h"
#include "src/core/triangle.h"

namespace lemma::test {

/// What a backend made of a case.
struct Outcome {
  std::size_t rays = 0;    // or other things tried
  std::size_t faults = 0;  // answers that cannot be; what that is the case says
};

/// A scene and rays that are known to be hard for accelerators. None of the rays may be answered by a fault:
/// tolerances are the bounds that the oracle derives (src/oracle/passage.h), and where no oracle is asked
/// there are none.
struct HardCase {
  std::string_view name;
  std::string_view expected;  // what is no fault
  Outcome (*run)(std::string_view backend);
  bool embree_too = false;  // whether Embree is held to it; else its faults are shown
};

[[nodiscard]] std::span<const HardCase> mesh_cases();
[[nodiscard]] std::span<const HardCase> surface_cases();
[[nodiscard]] std::span<const HardCase> furnace_cases();
[[nodiscard]] std::span<const HardCase> estimator_cases();  // of no backend; their "rays" are what is checked
[[nodiscard]] std::span<const HardCase> transport_cases();
/// Without accelerators: run once, as the backend "-".
[[nodiscard]] std::span<const HardCase> sampling_cases();

[[nodiscard]] std::unique_ptr<const Accelerator> make_backend(std::string_view name,
                                                              std::span<const Triangle> triangles);

/// Rays whose closest hit or occlusion the oracle refuses.
[[nodiscard]] Outcome judge(std::string_view backend, const std::vector<Triangle>& triangles,
                            const std::vector<Ray>& rays);

/// The first rays of all kinds of `lemma parity`.
[[nodiscard]] std::vector<Ray> rays_of_all_kinds(const std::vector<Triangle>& triangles, std::uint32_t count);

}  // namespace lemma::test
