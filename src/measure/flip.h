#pragma once

#include <vector>

#include "src/render/film.h"

namespace lemma {

/// FLIP: how different two images look when one is flipped to the other, a number in [0, 1] a pixel, row by
/// row; 0 where they look the same. Seen at 67 pixels a degree, as on a 0.7 m wide screen of 3840 pixels from
/// 0.7 m away. Source: Andersson et al., FLIP: A Difference Evaluator for Alternating Images, HPG 2020.
/// @param image, reference  of the same size, not empty; sRGB values in [0, 1]
[[nodiscard]] std::vector<float> ldr_flip(const Image& image, const Image& reference);

/// FLIP of linear radiance: the largest over exposures, from the one that shows the brightest pixel of the
/// reference to the one that shows the median one, tone-mapped by ACES. Where more than half of the reference
/// is black, the median is that of the rest. Source: Andersson et al., Visualizing Errors in Rendered High
/// Dynamic Range Images, Eurographics (short papers) 2021.
/// @param image, reference  of the same size, not empty; negative values count as 0
[[nodiscard]] std::vector<float> hdr_flip(const Image& image, const Image& reference);

}  // namespace lemma
