#pragma once

#include <array>
#include <vector>

#include "src/render/film.h"

namespace lemma {

/// How far an image I is from a reference R, over all pixels and channels.
struct ErrorFigures {
  double mse = 0;             // mean of (I - R)^2 [unit of the image squared]
  double relmse = 0;          // mean of (I - R)^2 / (R^2 + 0.01) [1]
  double trimmed_relmse = 0;  // the same without the 0.1 % of the pixels that have the largest
  double smape = 0;           // mean of 2 |I - R| / (|I| + |R|), where 0 / 0 is 0 [1], at most 2
  std::array<double, 3> mean_difference{};  // mean of I - R, a channel [unit of the image]
};

/// What keeps relMSE finite where the reference is black; 0.1 squared.
inline constexpr double kRelativeFloor = 0.01;

/// The part of the pixels that the trimmed relMSE leaves out.
inline constexpr double kTrimmedPart = 0.001;

/// @param image, reference  of the same size, not empty, all values finite
[[nodiscard]] ErrorFigures error_figures(const Image& image, const Image& reference);

/// What the noise of the reference adds to the figures on average, E (I - R)^2 = Var I + bias^2 + Var R: to
/// be subtracted.
struct ReferenceNoise {
  double mse = 0, relmse = 0;
};

/// @param variance  of the mean of each value of the reference
[[nodiscard]] ReferenceNoise reference_noise(const Image& reference, const Image& variance);

/// A pixel and how far it is from the reference: the root of the sum of squares over the channels.
struct PixelDifference {
  int x = 0, y = 0;
  double distance = 0;
};

/// The `count` pixels that differ most, or fewer if fewer differ; the largest first, of equal ones the first
/// row by row.
[[nodiscard]] std::vector<PixelDifference> largest_differences(const Image& image, const Image& reference,
                                                               std::size_t count);

}  // namespace lemma
