#include "src/app/scene_options.h"

#include <fmt/format.h>

#include "src/app/argument_error.h"
#include "src/app/value_option.h"

namespace lemma {
void add_scene_options(CLI::App& app, SceneOptions& o) {
  add_file(app,
           {.flag = "SCENE",
            .type = "PATH",
            .expected = "an XML file, an OBJ file, or the folder that holds both",
            .help = "The XML file, the OBJ file, or the folder that holds both"},
           [&o](const auto& path) { o.scene = path; })
      ->required();
  add_choice(
      app, "--brdf", lobes(), [&o](auto& entry) { o.load.brdf.lobe = entry.value; }, "The specular lobe");
  add_choice(
      app, "--phong-norm", phong_norms(), [&o](auto& entry) { o.load.brdf.norm = entry.value; },
      "Factor of the Phong lobe");
  add_choice(
      app, "--brdf-sampling", lobe_samplings(), [&o](auto& entry) { o.load.brdf.sampling = entry.value; },
      "Directions of the Phong lobe that are drawn");
  add_choice(
      app, "--emission", emission_rules(), [&o](auto& entry) { o.load.emission = entry.value; },
      "Which materials emit");
  add_choice(
      app, "--textures", texture_rules(), [&o](auto& entry) { o.load.textures = entry.value; },
      "What a texture does with the Kd of its material");
  app.add_flag("--strict", o.strict, "Take warnings about the scene for errors");
}

void report_warnings(const Warnings& warnings, bool strict) {
  for (const std::string& warning : warnings) fmt::print(stderr, "{}\n", warning);
  if (!strict || warnings.empty()) return;
  const std::string count = warnings.size() == 1 ? "1 warning" : fmt::format("{} warnings", warnings.size());
  throw ArgumentError(fmt::format("{}, which --strict takes for errors", count),
                      "mend the scene, or leave --strict out");
}

std::string text_of(const LoadOptions& o) {
  return fmt::format("--brdf {} --phong-norm {} --brdf-sampling {} --emission {} --textures {}",
                     name_of(lobes(), o.brdf.lobe), name_of(phong_norms(), o.brdf.norm),
                     name_of(lobe_samplings(), o.brdf.sampling), name_of(emission_rules(), o.emission),
                     name_of(texture_rules(), o.textures));
}

}  // namespace lemma
