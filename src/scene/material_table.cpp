#include "src/scene/material_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>

namespace lemma {
namespace {

constexpr Rgb kGrey{0.5f, 0.5f, 0.5f};  // where nothing better is known
constexpr float kAlbedoSlack = 1e-5f;   // 0.2 + 0.8 is not exactly 1 in float

using MaterialTest = bool (*)(const MtlMaterial&);

bool is_textured(const MtlMaterial& m) {
  return !m.map_kd.empty();
}
bool is_textured_black(const MtlMaterial& m) {
  return is_textured(m) && is_black(m.kd);
}
bool is_textured_colour(const MtlMaterial& m) {
  return is_textured(m) && !is_black(m.kd);
}
bool is_glass(const MtlMaterial& m) {
  return m.ni > 1;
}
bool gains_energy(const MtlMaterial& m) {
  return max_channel(m.kd + m.ks) > 1 + kAlbedoSlack;
}

/// The materials that reflect and pass a test: where the first is defined, and all names.
struct Selection {
  FilePosition where;
  std::vector<std::string> names;
};

Selection select(const std::vector<MtlMaterial>& materials, const std::vector<bool>& reflects,
                 MaterialTest test) {
  Selection selection;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!reflects[i] || !test(materials[i])) continue;
    if (selection.names.empty()) selection.where = materials[i].where;
    selection.names.push_back(materials[i].name);
  }
  return selection;
}

void warn_of_limits(const std::vector<MtlMaterial>& materials, const std::vector<bool>& reflects,
                    Warnings& warnings) {
  if (const Selection all = select(materials, reflects, is_textured); !all.names.empty()) {
    std::string what = "textures are left out:";
    const std::string colour = join_names(select(materials, reflects, is_textured_colour).names);
    const std::string black = join_names(select(materials, reflects, is_textured_black).names);
    if (!colour.empty()) what += fmt::format(" the Kd of {} is used", colour);
    if (!colour.empty() && !black.empty()) what += ";";
    if (!black.empty()) what += fmt::format(" grey 0.5 stands for {}, whose Kd is 0", black);
    warn(warnings, all.where, what);
  }
  if (const Selection glass = select(materials, reflects, is_glass); !glass.names.empty()) {
    warn(warnings, glass.where,
         fmt::format("glass (Ni > 1) is rendered as opaque: {}", join_names(glass.names)));
  }
  if (const Selection bright = select(materials, reflects, gains_energy); !bright.names.empty()) {
    warn(warnings, bright.where,
         fmt::format("Kd + Ks > 1: more light leaves than arrives, of {}", join_names(bright.names)));
  }
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
  warn_of_limits(materials, reflects, warnings);
  std::vector<Material> made;
  made.reserve(materials.size());
  for (const MtlMaterial& m : materials) {
    made.push_back(make_material(is_textured_black(m) ? kGrey : m.kd, m.ks, m.ns, brdf));
  }
  return made;
}

}  // namespace lemma
