#include <fmt/format.h>

#include "src/scene/load_scene.h"

namespace lemma {
namespace {

/// "1 light", "4 lights"; "0 lights".
std::string count(std::size_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string file_names(const LoadReport& report) {
  std::string names = fmt::format("{} + {}", report.xml.filename().string(), report.obj.filename().string());
  for (const std::filesystem::path& mtl : report.mtl) names += " + " + mtl.filename().string();
  return names;
}

std::string dropped(const LoadReport& report) {
  const std::size_t total = report.dropped_zero_area + report.dropped_non_finite;
  if (total == 0) return "0 dropped";
  return fmt::format("{} dropped: {} of zero area, {} not finite", total, report.dropped_zero_area,
                     report.dropped_non_finite);
}

/// "no textures", "1 texture in place of Kd", "3 textures times Kd".
std::string textures(const SceneNeeds& needs) {
  if (needs.textures == 0) return "no textures";
  return fmt::format("{} {} Kd", count(needs.textures, "texture"),
                     needs.texture_rule == TextureRule::replace ? "in place of" : "times");
}

}  // namespace

std::string describe(const SceneNeeds& needs) {
  return fmt::format("{}, {}, {}, {} normals, {} ({})", needs.model.specular ? "Lambert + Phong" : "Lambert",
                     needs.model.glass ? "glass" : "opaque", textures(needs),
                     needs.model.smooth_normals ? "smooth" : "flat", count(needs.lights, "light"),
                     count(needs.emitter_triangles, "triangle"));
}

std::string describe(const LoadedScene& loaded) {
  const auto& [scene, report] = loaded;
  return fmt::format("{}: {} ({}), {}, {} with {}, camera {}x{}", file_names(report),
                     count(report.triangles_read, "triangle"), dropped(report),
                     count(scene.materials.size(), "material"), count(scene.needs.lights, "light"),
                     count(scene.needs.emitter_triangles, "triangle"), scene.view.width, scene.view.height);
}

}  // namespace lemma
