#include "src/scene/glass.h"

#include <algorithm>
#include <array>

namespace lemma {
namespace {

/// The illumination models of the MTL specification in which light passes: 4 and 9 "glass", 6 and 7
/// "refraction".
constexpr std::array<float, 4> kTransparentModels{4, 6, 7, 9};

/// One number for all channels: 0 is opaque, 1 clear.
float classic_transparency(const MtlMaterial& m) {
  if (!m.tr.empty()) return m.tr.front();
  return m.d.empty() ? 0.0f : 1 - m.d.front();
}

bool allows_transparency(const MtlMaterial& m) {
  return m.illum.empty() ||
         std::ranges::find(kTransparentModels, m.illum.front()) != kTransparentModels.end();
}

Rgb transmittance_of(const MtlMaterial& m, Transparency transparency) {
  if (transparency == Transparency::by_index_alone) return {1, 1, 1};
  if (transparency == Transparency::colour) return {m.tr[0], m.tr[1], m.tr[2]};
  const float t = classic_transparency(m);
  return {t, t, t};
}

}  // namespace

Transparency transparency_of(const MtlMaterial& m) {
  if (!(m.ni > 1)) return Transparency::none;
  if (m.tr.size() == 3) return std::ranges::max(m.tr) > 0 ? Transparency::colour : Transparency::none;
  if (!m.tr.empty() || !m.d.empty()) {
    return classic_transparency(m) > 0 ? Transparency::classic : Transparency::none;
  }
  return allows_transparency(m) ? Transparency::by_index_alone : Transparency::none;
}

Dielectric glass_of(const MtlMaterial& m) {
  const Transparency transparency = transparency_of(m);
  if (transparency == Transparency::none) return {};
  return {m.inside_out ? 1 / m.ni : m.ni, transmittance_of(m, transparency)};
}

}  // namespace lemma
