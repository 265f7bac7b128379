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

/// Estimates V of different pixels are independent, so that the variance of their sum is that of each added
/// up, and Var V <= E V^2 whatever its distribution: the sum of V^2 bounds it without a word on tails, at the
/// cost of width where V is known well. The sum has then the mean and at most the variance of a chi-square
/// variable, scaled, of 2 (sum V)^2 / (sum V^2) degrees of freedom (Satterthwaite, An approximate
/// distribution of estimates of variance components, 1946), from which the interval follows. Where one pixel
/// carries most, few degrees are left and the interval is wide upwards; if that pixel's samples happened to
/// agree, what was not met cannot be told, and fewer intervals hold the truth: README says how many.
///
/// The figure that relmse is an interval of divides by the image's own square, since the true one is not
/// known: a pixel that met something bright divides by it, so that it is below that against the truth.
/// @param variance  of the mean of each value of `image`, of the same size
[[nodiscard]] EstimatedError estimated_error(const Image& image, const Image& variance);

}  // namespace lemma
