#pragma once

#include <span>

#include "src/core/named.h"
#include "src/render/film.h"

namespace lemma {

enum class ToneCurve {
  srgb,  // the sRGB transfer function (IEC 61966-2-1)
  gamma  // the report's power law: (L / max_radiance)^gamma
};

[[nodiscard]] std::span<const Named<ToneCurve>> tone_curves();

/// How linear radiance becomes the values in [0, 1] of a picture for the screen.
struct ToneMap {
  ToneCurve curve = ToneCurve::srgb;
  float exposure = 0;      // stops: radiance is multiplied by 2^exposure first
  float max_radiance = 1;  // radiance that becomes white
  float gamma = 0.25f;     // exponent of ToneCurve::gamma; the report used 0.25 with max_radiance 380

  /// Per channel; values beyond the range are clamped.
  [[nodiscard]] Rgb operator()(const Rgb& radiance) const;
};

[[nodiscard]] Image apply(const ToneMap& tone_map, const Image& image);

}  // namespace lemma
