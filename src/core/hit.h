#pragma once

#include <cstdint>
#include <type_traits>

namespace lemma {

/// Where a ray meets a triangle: at t along the ray, at (1 - b1 - b2) v0 + b1 v1 + b2 v2 of the triangle.
struct Hit {
  float t = 0;
  std::uint32_t triangle = 0;
  float b1 = 0, b2 = 0;

  friend bool operator==(const Hit&, const Hit&) = default;
};
static_assert(sizeof(Hit) == 16 && std::is_trivially_copyable_v<Hit>);

}  // namespace lemma
