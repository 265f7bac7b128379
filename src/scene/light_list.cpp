#include "src/scene/light_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "src/scene/ascii.h"

namespace lemma {
namespace {

std::string describe(const Rgb& c) {
  return fmt::format("{} {} {}", c.r, c.g, c.b);
}

void warn_unused(const XmlLight& light, const std::vector<MtlMaterial>& materials, Warnings& warnings) {
  const auto similar = std::find_if(materials.begin(), materials.end(), [&](const MtlMaterial& m) {
    return lower_case(m.name) == lower_case(light.material);
  });
  const std::string guess =
      similar == materials.end() ? "" : fmt::format("; is {} meant?", in_quotes(similar->name));
  warn(warnings, light.where,
       fmt::format("light {}: there is no such material{}", in_quotes(light.material), guess));
}

void add_light(const MaterialLight& light, LightList& list) {
  list.of_material[light.material] = static_cast<std::uint32_t>(list.lights.size());
  list.lights.push_back(light);
}

/// Whether Ka can be meant as a radiance: no reflectance is above 1.
bool is_radiant_ka(const MtlMaterial& m) {
  return max_channel(m.ka) > 1;
}

bool is_named_light(const MtlMaterial& m) {
  return lower_case(m.name).find("light") != std::string::npos;
}

/// The light that a material makes by itself; one of radiance 0 if it makes none.
MaterialLight own_light(const MtlMaterial& m, std::uint32_t index, EmissionRule rule) {
  if (!is_black(m.ke)) return {index, m.ke, m.where, "Ke"};
  if (rule != EmissionRule::declared && is_radiant_ka(m)) return {index, m.ka, m.where, "Ka"};
  if (rule == EmissionRule::name && is_named_light(m)) return {index, {1, 1, 1}, m.where, "name"};
  return {index, {}, m.where, ""};
}

/// Whether a material without light looks as if it were meant to be one: by its name, or by a Ka
/// that is one (in some scenes of the course).
bool looks_like_light(const MtlMaterial& m) {
  return is_named_light(m) || is_radiant_ka(m) || max_channel(m.ke) > 0;
}

}  // namespace

std::span<const Named<EmissionRule>> emission_rules() {
  static constexpr Named<EmissionRule> table[] = {
      {"declared", EmissionRule::declared, "materials that the XML names as lights, and others with Ke"},
      {"ka", EmissionRule::ka,
       "these, and others with a Ka above 1: it is their radiance (a dialect of 2019)"},
      {"name", EmissionRule::name, "these, and others whose name holds \"light\", with radiance 1"}};
  return table;
}

LightList find_lights(const XmlScene& xml, const std::vector<MtlMaterial>& materials, EmissionRule rule,
                      Warnings& warnings) {
  LightList list;
  list.of_material.assign(materials.size(), kNoLight);
  std::unordered_map<std::string, std::uint32_t> index;
  for (std::uint32_t i = 0; i < materials.size(); ++i) index.try_emplace(materials[i].name, i);

  std::vector<bool> in_xml(materials.size(), false);
  for (const XmlLight& light : xml.lights) {
    const auto material = index.find(light.material);
    if (material == index.end()) {
      warn_unused(light, materials, warnings);
      continue;
    }
    const MtlMaterial& m = materials[material->second];
    in_xml[material->second] = true;
    if (!is_black(m.ke) && m.ke != light.radiance) {
      warn(warnings, m.where,
           fmt::format("Ke {} of {} is left out: the XML gives a radiance", describe(m.ke),
                       in_quotes(m.name)));
    }
    if (is_black(light.radiance)) {
      warn(warnings, light.where,
           fmt::format("light {} has radiance 0 and reflects instead", in_quotes(m.name)));
    } else {
      add_light({material->second, light.radiance, light.where, "XML"}, list);
    }
  }
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    const MaterialLight light = own_light(materials[i], i, rule);
    if (in_xml[i] || is_black(light.radiance)) continue;
    add_light(light, list);
    if (light.source == "Ke") continue;
    warn(warnings, light.where,
         fmt::format("{} emits {} by its {}", in_quotes(materials[i].name), describe(light.radiance),
                     light.source));
  }
  return list;
}

void number_lights(const LightList& list, const std::vector<MtlMaterial>& materials, Scene& scene,
                   Warnings& warnings) {
  std::vector<std::uint32_t> number(list.lights.size(), kNoLight);
  for (const Emitter& e : scene.emitters) number[e.light] = 0;
  std::uint32_t used = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] != kNoLight) {
      number[i] = used++;
    } else {
      warn(warnings, list.lights[i].where,
           fmt::format("light {} has no triangle", in_quotes(materials[list.lights[i].material].name)));
    }
  }
  for (Emitter& e : scene.emitters) e.light = number[e.light];
  scene.needs.lights = used;
  scene.needs.emitter_triangles = scene.emitters.size();
}

SceneError no_emitters(const FilePosition& where, const std::vector<MtlMaterial>& materials,
                       const std::vector<bool>& has_faces) {
  std::vector<std::string> candidates;
  bool by_ka = false;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!has_faces[i] || !looks_like_light(materials[i])) continue;
    by_ka |= is_radiant_ka(materials[i]);
    candidates.push_back(fmt::format("{} (Ka {})", in_quotes(materials[i].name), describe(materials[i].ka)));
  }
  const std::string example = fmt::format("write {} into the XML", kLightExample);
  if (candidates.empty()) {
    return {where, "no emitters found: the image would be black",
            fmt::format("{}, with the name of a material", example)};
  }
  return {where, "no emitters found: the image would be black",
          fmt::format("candidates: {}; {}, or let --emission {} take what looks like a light",
                      join_names(candidates), example, by_ka ? "ka" : "name")};
}

}  // namespace lemma
