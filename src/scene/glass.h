#pragma once

#include <vector>

#include "src/scene/read_mtl.h"
#include "src/shading/dielectric.h"

namespace lemma {

/// How a material says that light passes it, or does not.
enum class Transparency {
  none,           // Ni is not above 1, or what the file says besides makes it opaque
  colour,         // Tr of three numbers, a transmittance (scenes of the course from 2022 on)
  classic,        // one number: Tr, or else 1 - d
  by_index_alone  // nothing is said but Ni, and no illum without transparency: light passes undimmed
};

[[nodiscard]] Transparency transparency_of(const MtlMaterial& material);

/// The boundary of glass that a material stands for; ior is 1 if it is none. Only Ni > 1 makes glass: `Tr 1 1
/// 1` and `d` stand on opaque materials too. Of a material with Ni > 1, Tr, then d, then illum decide:
/// exporters write Ni 1.45 or 1.5 on everything. Its Kd and Ks do not count.
[[nodiscard]] Dielectric glass_of(const MtlMaterial& material);

[[nodiscard]] inline bool is_glass(const MtlMaterial& material) {
  return transparency_of(material) != Transparency::none;
}

}  // namespace lemma
