#pragma once

#include "src/render/film.h"

namespace lemma {

/// A figure with the ends of its 95 % confidence interval.
struct Interval {
  double value = 0, low = 0, high = 0;
};

/// The errors that an image has on average over seeds, from the estimated variances of its values alone: a
/// bias is not seen.
struct EstimatedError {
  Interval rmse;    // root of the mean variance
  Interval relmse;  // mean of variance / (I^2 + 0.01)
};

/// Estimates of different pixels are independent, so that the spread of their contributions tells the
/// standard error of the mean; it is too large, if anything, since the pixels' true variances differ too.
/// Intervals are those of the logarithm, which keeps them above 0.
/// @param variance  of the mean of each value of `image`, of the same size
[[nodiscard]] EstimatedError estimated_error(const Image& image, const Image& variance);

}  // namespace lemma
