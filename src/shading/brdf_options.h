#pragma once

#include <span>

#include "src/core/named.h"

namespace lemma {

/// Between which directions the angle alpha of the specular lobe cos^n(alpha) lies.
enum class Lobe {
  phong,       // the light and the mirror direction: the report's eq. (3)
  blinn_phong  // the normal and the half vector: Blinn, Models of Light Reflection, SIGGRAPH 1977
};

/// The factor in front of the Phong lobe: (n + 1) / (2 pi), the report's eq. (3), or (n + 2) / (2 pi), which
/// makes the albedo at normal incidence 1 for ks = 1 (Lafortune and Willems, Using the Modified Phong
/// Reflectance Model, 1994).
enum class PhongNorm { n_plus_1, n_plus_2 };

/// How directions of the Phong lobe are drawn.
enum class LobeSampling {
  truncated,  // only those above the surface
  p6          // all about the mirror direction; those below the surface are lost, as in the report's p6
};

[[nodiscard]] std::span<const Named<Lobe>> lobes();
[[nodiscard]] std::span<const Named<PhongNorm>> phong_norms();
[[nodiscard]] std::span<const Named<LobeSampling>> lobe_samplings();

/// What is chosen for all materials of a scene.
struct BrdfOptions {
  Lobe lobe = Lobe::phong;
  PhongNorm norm = PhongNorm::n_plus_1;
  LobeSampling sampling = LobeSampling::truncated;
};

}  // namespace lemma
