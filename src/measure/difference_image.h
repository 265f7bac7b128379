#pragma once

#include "src/render/film.h"

namespace lemma {

/// I - R, channel by channel; may be negative.
[[nodiscard]] Image signed_difference(const Image& image, const Image& reference);

/// Absolute difference of luminance that all but one pixel of a hundred stay below; 1 if nothing differs.
[[nodiscard]] double difference_scale(const Image& image, const Image& reference);

/// The difference of luminance in colours for the screen: white where there is none, red where the image is
/// brighter than the reference, blue where it is darker, full at `scale`.
[[nodiscard]] Image false_color(const Image& image, const Image& reference, double scale);

}  // namespace lemma
