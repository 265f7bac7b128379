#pragma once

#include <numbers>
#include <vector>

#include "src/render/film.h"

namespace lemma {

/// From where FLIP sees an image: the pixels that a degree holds on a 0.7 m wide screen of 3840 pixels, 0.7 m
/// away.
inline constexpr double kFlipPixelsPerDegree = 0.7 * 3840 / 0.7 * std::numbers::pi / 180;

/// FLIP: how different two images look when one is flipped to the other, a number in [0, 1] a pixel, row by
/// row; 0 where they look the same. Source: Andersson et al., FLIP: A Difference Evaluator for Alternating
/// Images, HPG 2020.
/// @param image, reference  of the same size, not empty; sRGB values in [0, 1]
[[nodiscard]] std::vector<float> ldr_flip(const Image& image, const Image& reference);

/// Evenly spaced exposures [stops]: radiance is multiplied by 2^exposure.
struct FlipExposures {
  double first = 0, step = 0;
  int count = 1;

  [[nodiscard]] double exposure(int i) const { return first + i * step; }
};

/// From the exposure that shows the brightest pixel of the reference to the one that shows the median one.
/// Where more than half of the reference is black, the median is that of the rest.
[[nodiscard]] FlipExposures flip_exposures(const Image& reference);

/// FLIP of linear radiance: the largest over flip_exposures(reference), tone-mapped by ACES. Source:
/// Andersson et al., Visualizing Errors in Rendered High Dynamic Range Images, Eurographics (short papers)
/// 2021.
/// @param image, reference  of the same size, not empty; negative values count as 0
[[nodiscard]] std::vector<float> hdr_flip(const Image& image, const Image& reference);

}  // namespace lemma
