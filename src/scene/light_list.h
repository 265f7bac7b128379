#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "src/scene/load_scene.h"
#include "src/scene/material_table.h"
#include "src/scene/read_xml.h"
#include "src/scene/scene.h"

namespace lemma {

/// The faces of one material emit this radiance.
struct MaterialLight {
  std::uint32_t material = 0;  // index into MaterialTable::materials
  Rgb radiance;                // not black
  FilePosition where;
  std::string_view source;  // what says so: "XML", "Ke", "Ka", "name"
};

inline constexpr std::uint32_t kNoLight = 0xFFFFFFFFu;

/// The lights of a scene and the light, or kNoLight, of each material.
struct LightList {
  std::vector<MaterialLight> lights;
  std::vector<std::uint32_t> of_material;
};

/// The lights of the XML in its order, then the materials of which the XML says nothing and that emit by the
/// rule: a material never emits by two. A light of radiance 0 is none, so that its faces reflect. Warns of
/// XML lights without material, of black ones, of a Ke that the XML contradicts, and of what emits by Ka or
/// name.
[[nodiscard]] LightList find_lights(const XmlScene& xml, const std::vector<MtlMaterial>& materials,
                                    EmissionRule rule, Warnings& warnings);

/// Renumbers the lights of scene.emitters, so that those without a triangle take no number, and fills in the
/// counts of scene.needs. Warns of lights without triangle.
void number_lights(const LightList& list, const std::vector<MtlMaterial>& materials, Scene& scene,
                   Warnings& warnings);

/// What to say of a scene in which nothing emits: which materials look as if they should.
/// @param has_faces  of each material
[[nodiscard]] SceneError no_emitters(const FilePosition& where, const std::vector<MtlMaterial>& materials,
                                     const std::vector<bool>& has_faces);

}  // namespace lemma
