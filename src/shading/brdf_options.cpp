#include "src/shading/brdf_options.h"

namespace lemma {

std::span<const Named<Lobe>> lobes() {
  static constexpr Named<Lobe> table[] = {
      {"phong", Lobe::phong, "about the mirror direction (the report's eq. (3))"},
      {"blinn-phong", Lobe::blinn_phong,
       "of the half vector about the normal, albedo 1 at normal incidence for ks 1"}};
  return table;
}

std::span<const Named<PhongNorm>> phong_norms() {
  static constexpr Named<PhongNorm> table[] = {
      {"n+1", PhongNorm::n_plus_1, "(n + 1) / (2 pi), the report's eq. (3)"},
      {"n+2", PhongNorm::n_plus_2, "(n + 2) / (2 pi), albedo 1 at normal incidence for ks 1"}};
  return table;
}

std::span<const Named<LobeSampling>> lobe_samplings() {
  static constexpr Named<LobeSampling> table[] = {
      {"truncated", LobeSampling::truncated, "those above the surface only"},
      {"p6", LobeSampling::p6, "all; those below the surface are lost (the report's p6)"}};
  return table;
}

}  // namespace lemma
