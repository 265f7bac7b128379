#include "src/scene/material_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "src/scene/glass.h"

namespace lemma {
namespace {

constexpr float kAlbedoSlack = 1e-5f;  // 0.2 + 0.8 is not exactly 1 in float

bool is_textured_black(const MtlMaterial& m) {
  return !m.map_kd.empty() && is_black(m.kd);
}
bool gains_energy(const MtlMaterial& m) {
  return max_channel(m.kd + m.ks) > 1 + kAlbedoSlack;
}

/// Some of the materials: where the first is defined, and all names.
struct Selection {
  FilePosition where;
  std::vector<std::string> names;
};

void warn_of_gain(const std::vector<MtlMaterial>& materials, const std::vector<bool>& reflects,
                  Warnings& warnings) {
  Selection bright;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MtlMaterial& m = materials[i];
    if (!reflects[i] || is_glass(m) || !gains_energy(m)) continue;
    if (bright.names.empty()) bright.where = m.where;
    if (bright.names.empty() || bright.names.back() != m.name) bright.names.push_back(m.name);
  }
  if (bright.names.empty()) return;
  warn(warnings, bright.where,
       fmt::format("Kd + Ks > 1: more light leaves than arrives, of {}", join_names(bright.names)));
}

}  // namespace

MaterialTable read_materials(const std::vector<std::filesystem::path>& mtl_files,
                             const std::vector<ObjName>& names, Warnings& warnings) {
  MaterialTable table;
  for (const std::filesystem::path& file : mtl_files) {
    std::vector<MtlMaterial> read = read_mtl(file, warnings);
    std::move(read.begin(), read.end(), std::back_inserter(table.materials));
  }
  std::unordered_map<std::string, std::uint32_t> index;
  for (std::uint32_t i = 0; i < table.materials.size(); ++i) index.try_emplace(table.materials[i].name, i);

  Selection undefined;
  for (const ObjName& name : names) {
    const auto [entry, is_new] =
        index.try_emplace(name.name, static_cast<std::uint32_t>(table.materials.size()));
    if (is_new) {
      MtlMaterial& grey = table.materials.emplace_back();
      grey.name = name.name;
      grey.where = name.where;
      grey.kd = kGrey;
      if (undefined.names.empty()) undefined.where = name.where;
      undefined.names.push_back(name.name.empty() ? "faces without usemtl" : name.name);
    }
    table.of_obj.push_back(entry->second);
  }
  if (!undefined.names.empty()) {
    warn(warnings, undefined.where,
         fmt::format("no material is defined for {}; Kd 0.5 is used", join_names(undefined.names)));
  }
  return table;
}

std::vector<Material> make_materials(const std::vector<MtlMaterial>& materials,
                                     const std::vector<bool>& reflects, const BrdfOptions& brdf,
                                     Warnings& warnings) {
  warn_of_gain(materials, reflects, warnings);
  std::vector<Material> made;
  made.reserve(materials.size());
  for (const MtlMaterial& m : materials) {
    made.push_back(make_material(is_textured_black(m) ? kGrey : m.kd, m.ks, m.ns, brdf));
  }
  return made;
}

}  // namespace lemma
