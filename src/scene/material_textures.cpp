#include "src/scene/material_textures.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "src/scene/glass.h"
#include "src/scene/scene_files.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

std::optional<FoundFile> find_image(const MtlMaterial& m, const fs::path& obj) {
  const fs::path beside_mtl = m.map_kd_where.file.parent_path(), beside_obj = obj.parent_path();
  if (auto found = find_file(beside_mtl, m.map_kd)) return found;
  return beside_obj == beside_mtl ? std::nullopt : find_file(beside_obj, m.map_kd);
}

/// Images by their files, each read once; those that cannot be read are remembered, too.
class TextureLoader {
 public:
  TextureLoader(const fs::path& obj, Scene& scene, Warnings& warnings)
      : obj_(obj), scene_(scene), warnings_(warnings) {}

  /// Index of a material's texture; kNoTexture, with a warning, if it has none that can be read.
  std::uint32_t load(const MtlMaterial& m) {
    const std::optional<FoundFile> image = find_image(m, obj_);
    if (!image) return fall_back(m, fmt::format("there is no texture {}", in_quotes(m.map_kd)));
    if (!image->as_written) {
      warn(warnings_, m.map_kd_where,
           fmt::format("there is no {}; {} is used", in_quotes(m.map_kd), image->path.filename().string()));
    }
    std::error_code error;
    const fs::path file = fs::canonical(image->path, error);  // one image may have several names
    const auto [entry, is_new] = index_.try_emplace(error ? image->path : file, kNoTexture);
    if (is_new) entry->second = read(entry->first);
    if (entry->second != kNoTexture) return entry->second;
    return fall_back(
        m, fmt::format("the texture {} cannot be read: {}", in_quotes(m.map_kd), why_not_[entry->first]));
  }

 private:
  std::uint32_t read(const fs::path& file) {
    try {
      scene_.textures.emplace_back(file);
      return static_cast<std::uint32_t>(scene_.textures.size() - 1);
    } catch (const TextureError& error) {
      why_not_[file] = error.what();
      return kNoTexture;
    }
  }

  std::uint32_t fall_back(const MtlMaterial& m, const std::string& what) {
    warn(warnings_, m.map_kd_where,
         fmt::format("{}; {} stands in its place", what, is_black(m.kd) ? "grey 0.5" : "Kd"));
    return kNoTexture;
  }

  fs::path obj_;
  Scene& scene_;
  Warnings& warnings_;
  std::map<fs::path, std::uint32_t> index_;
  std::map<fs::path, std::string> why_not_;
};

}  // namespace

std::span<const Named<TextureRule>> texture_rules() {
  static constexpr Named<TextureRule> table[] = {
      {"replace", TextureRule::replace, "in place of Kd, as in the course's renderers"},
      {"multiply", TextureRule::multiply,
       "times Kd, as the MTL specification says: where Kd is 0 all is black"}};
  return table;
}

void load_textures(const std::vector<MtlMaterial>& materials, const std::vector<bool>& shown,
                   const fs::path& obj, TextureRule rule, Scene& scene, Warnings& warnings) {
  TextureLoader loader(obj, scene, warnings);
  std::vector<MaterialTexture> texture_of(materials.size());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MtlMaterial& m = materials[i];
    if (!shown[i] || m.map_kd.empty() || is_glass(m)) continue;
    texture_of[i] = {loader.load(m), rule == TextureRule::multiply ? m.kd : Rgb{1, 1, 1}};
  }
  scene.needs.textures = scene.textures.size();
  scene.needs.texture_rule = rule;
  scene.needs.model.textures = !scene.textures.empty();
  if (scene.needs.model.textures) {
    scene.texture_of = std::move(texture_of);
  } else {
    decltype(scene.texcoords)().swap(scene.texcoords);
  }
}

}  // namespace lemma
