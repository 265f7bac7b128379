#pragma once

#include <memory>
#include <span>

#include "src/lights/light_sampler.h"

namespace lemma {

/// A strategy that chooses the emitter triangle by weights fixed beforehand and the point on it uniformly by
/// area: pdf = pmf / area, turned into solid angle.
/// @param weights  one an emitter, >= 0, not all 0
[[nodiscard]] std::unique_ptr<const LightSampler> make_area_sampler(std::span<const Emitter> emitters,
                                                                    std::span<const double> weights);

}  // namespace lemma
