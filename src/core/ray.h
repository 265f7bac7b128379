#pragma once

#include <limits>

#include "src/core/vec.h"

namespace lemma {

/// Points origin + t direction with t in the open interval (t_min, t_max). The direction need not have unit
/// length: t is in units of it.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  float t_min = 0;
  float t_max = std::numeric_limits<float>::infinity();
};

}  // namespace lemma
