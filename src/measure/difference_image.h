#pragma once

#include <array>

#include "src/render/film.h"

namespace lemma {

/// Colours of differences from -1 to 1, evenly spaced: a diverging map of nearly even steps to the eye that
/// colour-blind people can read. Values in between are mixed. Source: RdBu of eleven classes, every second,
/// with white in the middle (Cynthia Brewer, colorbrewer2.org).
inline constexpr std::array<Rgb, 7> kDifferenceColors = {{{0.02f, 0.19f, 0.38f},
                                                          {0.26f, 0.58f, 0.76f},
                                                          {0.82f, 0.90f, 0.94f},
                                                          {1, 1, 1},
                                                          {0.99f, 0.86f, 0.78f},
                                                          {0.84f, 0.38f, 0.30f},
                                                          {0.40f, 0, 0.12f}}};

/// I - R, channel by channel; may be negative.
[[nodiscard]] Image signed_difference(const Image& image, const Image& reference);

/// Absolute difference of luminance that all but one pixel of a hundred stay below; 1 if nothing differs.
[[nodiscard]] double difference_scale(const Image& image, const Image& reference);

/// The difference of luminance in kDifferenceColors for the screen: white where there is none, red where the
/// image is brighter than the reference, blue where it is darker, full at `scale`.
[[nodiscard]] Image false_color(const Image& image, const Image& reference, double scale);

}  // namespace lemma
