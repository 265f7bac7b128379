#include "src/render/tone_map.h"

#include <algorithm>
#include <cmath>

namespace lemma {
namespace {

float srgb_curve(float x) {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

}  // namespace

std::span<const Named<ToneCurve>> tone_curves() {
  static constexpr Named<ToneCurve> table[] = {
      {"srgb", ToneCurve::srgb, "the sRGB curve"},
      {"gamma", ToneCurve::gamma, "the report's (L / max-radiance)^gamma"},
  };
  return table;
}

Rgb ToneMap::operator()(const Rgb& radiance) const {
  const float scale = std::exp2(exposure) / max_radiance;
  const auto channel = [&](float c) {
    const float x = std::clamp(c * scale, 0.0f, 1.0f);
    return curve == ToneCurve::srgb ? srgb_curve(x) : std::pow(x, gamma);
  };
  return {channel(radiance.r), channel(radiance.g), channel(radiance.b)};
}

Image apply(const ToneMap& tone_map, const Image& image) {
  Image mapped = image;
  std::ranges::transform(mapped.pixels, mapped.pixels.begin(), tone_map);
  return mapped;
}

}  // namespace lemma
