#include "src/app/check_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace lemma {
namespace {

constexpr int kSamplesAPixel = 16;  // what `lemma render` takes when it is not told

std::string text_of(const Vec3& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z);
}

std::string facing(const LightCheck& light) {
  return fmt::format("{}{}", light.direction ? text_of(*light.direction) : "all round",
                     light.faces_away ? ", away from all that reflects" : "");
}

std::string file_lines(const SceneCheck& check) {
  const LoadReport& report = check.loaded.report;
  std::string text = fmt::format("files: {} ({}), {}", report.xml.filename().string(), report.dialect,
                                 report.obj.filename().string());
  for (const auto& mtl : report.mtl) text += ", " + mtl.filename().string();
  return text + "\n";
}

std::string geometry_lines(const SceneCheck& check) {
  const LoadReport& report = check.loaded.report;
  const Bounds& b = check.bounds;
  return fmt::format(
      "geometry: {} triangles of {} vertices, from {} to {}\n"
      "  dropped: {} of zero area, {} not finite\n"
      "  duplicate: {}; normals against the winding: {}; under a light in their plane: {}; without texture "
      "coordinates: {}\n",
      report.triangles_read, check.vertices, text_of(b.lo), text_of(b.hi), report.dropped_zero_area,
      report.dropped_non_finite, check.duplicates, report.opposed_normals, check.under_lights,
      report.without_texcoords);
}

std::string light_lines(const SceneCheck& check) {
  std::string text = fmt::format("lights: {}\n", check.lights.size());
  for (const LightCheck& l : check.lights) {
    text += fmt::format("  {}: radiance {} {} {} by {}, {} triangles, area {:.4g}, power {:.4g}, faces {}\n",
                        l.name, l.radiance.r, l.radiance.g, l.radiance.b, l.source, l.triangles, l.area,
                        l.power, facing(l));
  }
  return text;
}

std::string material_lines(const SceneCheck& check) {
  std::string text = fmt::format("materials: {}\n", check.materials.size());
  for (const MaterialCheck& m : check.materials) {
    text += fmt::format("  {}: {} triangles, {}\n", m.name.empty() ? "(faces without usemtl)" : m.name,
                        m.triangles, m.meaning);
  }
  return text;
}

std::string cost_lines(const SceneCheck& check, const std::vector<AcceleratorCost>& costs) {
  const CameraView& view = check.loaded.scene.view;
  std::string text = "costs, from a few thousand samples on this machine:\n";
  for (const AcceleratorCost& c : costs) {
    const double samples = double(view.width) * double(view.height) * kSamplesAPixel;
    text += fmt::format(
        "  {}: {:.1f} MB, built in {:.3f} s, {:.2f} us a sample: {}x{} with {} samples a pixel in about "
        "{:.3g} s\n",
        c.name, static_cast<double>(c.bytes) / 1e6, c.build_seconds, c.seconds_a_sample * 1e6, view.width,
        view.height, kSamplesAPixel, c.seconds_a_sample * samples);
  }
  return text;
}

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json lights_json(const SceneCheck& check) {
  Json lights = Json::array();
  for (const LightCheck& l : check.lights) {
    lights.push_back({{"name", l.name},
                      {"by", l.source},
                      {"radiance", Json::array({l.radiance.r, l.radiance.g, l.radiance.b})},
                      {"triangles", l.triangles},
                      {"area", l.area},
                      {"power", l.power},
                      {"direction", l.direction ? vector_json(*l.direction) : Json()},
                      {"faces_away", l.faces_away}});
  }
  return lights;
}

Json materials_json(const SceneCheck& check) {
  Json materials = Json::array();
  for (const MaterialCheck& m : check.materials) {
    materials.push_back(
        {{"name", m.name}, {"triangles", m.triangles}, {"defined", m.defined}, {"meaning", m.meaning}});
  }
  return materials;
}

Json costs_json(const std::vector<AcceleratorCost>& costs) {
  Json json = Json::array();
  for (const AcceleratorCost& c : costs) {
    json.push_back({{"accel", c.name},
                    {"bytes", c.bytes},
                    {"build_seconds", c.build_seconds},
                    {"seconds_a_sample", c.seconds_a_sample}});
  }
  return json;
}

}  // namespace

std::string check_text(const SceneCheck& check, const std::vector<AcceleratorCost>& costs) {
  const Scene& scene = check.loaded.scene;
  std::string text = file_lines(check);
  if (!scene.facets.empty()) {
    text += fmt::format("model: {}\n", describe(scene.needs));
    text += fmt::format("camera: {}x{}, fovy {}, from {} to {}\n", scene.view.width, scene.view.height,
                        scene.view.fovy, text_of(scene.view.eye), text_of(scene.view.look_at));
    text += geometry_lines(check) + light_lines(check) + material_lines(check);
  }
  if (!costs.empty()) text += cost_lines(check, costs);
  text += fmt::format("warnings: {}\n", check.loaded.report.warnings.size());
  for (const std::string& warning : check.loaded.report.warnings) text += "  " + warning + "\n";
  return text;
}

std::string check_json(const SceneCheck& check, const std::vector<AcceleratorCost>& costs) {
  const auto& [scene, report] = check.loaded;
  Json json = {{"version", LEMMA_VERSION},
               {"renderable", !check.error},
               {"error", check.error ? Json(*check.error) : Json()},
               {"xml", report.xml.string()},
               {"dialect", report.dialect},
               {"obj", report.obj.string()},
               {"mtl", Json::array()},
               {"model", scene.facets.empty() ? Json() : Json(describe(scene.needs))},
               {"width", scene.view.width},
               {"height", scene.view.height},
               {"vertices", check.vertices},
               {"triangles", report.triangles_read},
               {"dropped_zero_area", report.dropped_zero_area},
               {"dropped_not_finite", report.dropped_non_finite},
               {"duplicates", check.duplicates},
               {"opposed_normals", report.opposed_normals},
               {"under_lights", check.under_lights},
               {"without_texture_coordinates", report.without_texcoords},
               {"lights", lights_json(check)},
               {"materials", materials_json(check)},
               {"costs", costs_json(costs)},
               {"warnings", report.warnings}};
  for (const auto& mtl : report.mtl) json["mtl"].push_back(mtl.string());
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // names may be no UTF-8
}

}  // namespace lemma
