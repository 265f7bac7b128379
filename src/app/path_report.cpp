#include "src/app/path_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace lemma {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Rgb& c) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", c.r, c.g, c.b);
}

std::string text(const Vec3& v) {
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", v.x, v.y, v.z);
}

/// "brdf 0.318, tree 0.02, power 0.001".
std::string text(const Densities& d) {
  std::string densities = fmt::format("brdf {:.4g}", d.brdf);
  for (std::size_t i = 0; i < d.light.size(); ++i) {
    densities += fmt::format(", {} {:.4g}", light_samplers()[i].name, d.light[i]);
  }
  return densities;
}

std::string_view name_of(LightFate fate) {
  switch (fate) {
    case LightFate::none:
      return "none";
    case LightFate::below:
      return "below the surface";
    case LightFate::covered:
      return "covered by another emitter";
    case LightFate::hidden:
      return "hidden";
    case LightFate::missed:
      return "missed for something else";
    case LightFate::seen:
      return "seen";
  }
  return {};
}

std::string_view name_of(PathEnd end) {
  switch (end) {
    case PathEnd::escaped:
      return "leaves the scene";
    case PathEnd::cut:
      return "is cut: --max-depth";
    case PathEnd::done:
      return "no direction meets a surface that scatters";
  }
  return {};
}

/// A line for each kind of event.
struct TextOf {
  std::string operator()(const SurfaceEvent& e) const {
    return fmt::format("  surface: triangle {}, material {}, at {}, normal {}; throughput {}\n", e.triangle,
                       e.material, text(e.position), text(e.normal), text(e.throughput));
  }
  std::string operator()(const LightEvent& e) const {
    if (e.fate == LightFate::none) return "    light sample: none, the light sends nothing here\n";
    const bool met = e.emitter != kNoEmitter;
    return fmt::format(
        "    light sample: {}, {}, towards {}, {}radiance {}, f cos {}\n"
        "      densities [1/sr]: {}\n      drawn with {:.4g}, weight {:.4g}: contributes {}\n",
        met ? fmt::format("emitter {}", e.emitter) : "a round light", name_of(e.fate), text(e.wi),
        met ? fmt::format("distance {:.5g}, ", e.distance) : "", text(e.radiance), text(e.f_cos),
        text(e.densities), e.pdf, e.weight, text(e.contribution));
  }
  std::string operator()(const ScatterEvent& e) const {
    if (e.absorbed) return "    BRDF sample: none, absorbed\n";
    return fmt::format("    BRDF sample: towards {}, density {:.4g}, f cos / density {}\n", text(e.wi), e.pdf,
                       text(e.weight));
  }
  std::string operator()(const EmitterEvent& e) const {
    const bool from_camera = e.densities.light.empty();
    return fmt::format("{}: emitter {}, radiance {}\n", from_camera ? "  camera" : "    it meets an emitter",
                       e.emitter, text(e.radiance)) +
           (from_camera ? "" : fmt::format("      densities [1/sr]: {}\n", text(e.densities))) +
           fmt::format("      weight {:.4g}: contributes {}\n", e.weight, text(e.contribution));
  }
  std::string operator()(const ChoiceEvent& e) const {
    return fmt::format("    goes on with the {} sample, chosen with probability {:.4g}\n",
                       e.light ? "light" : "BRDF", e.probability);
  }
  std::string operator()(const RouletteEvent& e) const {
    return fmt::format("    roulette: {} (probability to go on {:.4g})\n", e.survived ? "goes on" : "ends",
                       e.survival);
  }
  std::string operator()(const EndEvent& e) const { return fmt::format("    {}\n", name_of(e.why)); }
};

Json json(const Rgb& c) {
  return {c.r, c.g, c.b};
}

Json json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

Json json(const Densities& d) {
  Json densities = {{"brdf", d.brdf}};
  for (std::size_t i = 0; i < d.light.size(); ++i) densities[light_samplers()[i].name] = d.light[i];
  return densities;
}

struct JsonOf {
  Json operator()(const SurfaceEvent& e) const {
    return {{"event", "surface"},           {"triangle", e.triangle},   {"material", e.material},
            {"position", json(e.position)}, {"normal", json(e.normal)}, {"throughput", json(e.throughput)}};
  }
  Json operator()(const LightEvent& e) const {
    if (e.fate == LightFate::none) return {{"event", "light"}, {"fate", name_of(e.fate)}};
    const bool met = e.emitter != kNoEmitter;
    return {{"event", "light"},
            {"fate", name_of(e.fate)},
            {"emitter", met ? Json(e.emitter) : Json()},
            {"wi", json(e.wi)},
            {"distance", met ? Json(e.distance) : Json()},
            {"radiance", json(e.radiance)},
            {"f_cos", json(e.f_cos)},
            {"densities", json(e.densities)},
            {"pdf", e.pdf},
            {"weight", e.weight},
            {"contribution", json(e.contribution)}};
  }
  Json operator()(const ScatterEvent& e) const {
    if (e.absorbed) return {{"event", "scatter"}, {"absorbed", true}};
    return {{"event", "scatter"}, {"wi", json(e.wi)}, {"pdf", e.pdf}, {"weight", json(e.weight)}};
  }
  Json operator()(const EmitterEvent& e) const {
    return {{"event", "emitter"},           {"emitter", e.emitter},
            {"radiance", json(e.radiance)}, {"densities", json(e.densities)},
            {"weight", e.weight},           {"contribution", json(e.contribution)}};
  }
  Json operator()(const ChoiceEvent& e) const {
    return {{"event", "choice"}, {"sample", e.light ? "light" : "brdf"}, {"probability", e.probability}};
  }
  Json operator()(const RouletteEvent& e) const {
    return {{"event", "roulette"},
            {"survival", e.survival},
            {"survived", e.survived},
            {"throughput", json(e.throughput)}};
  }
  Json operator()(const EndEvent& e) const { return {{"event", "end"}, {"why", name_of(e.why)}}; }
};

}  // namespace

std::string path_text(const ExplainedSample& sample) {
  std::string lines = fmt::format("sample {}: radiance {}\n", sample.index, text(sample.radiance));
  if (sample.events.empty()) lines += "  the camera ray meets nothing\n";
  for (const PathEvent& event : sample.events) lines += std::visit(TextOf{}, event);
  return lines;
}

nlohmann::ordered_json path_json(const ExplainedSample& sample) {
  Json events = Json::array();
  for (const PathEvent& event : sample.events) events.push_back(std::visit(JsonOf{}, event));
  return {{"sample", sample.index},
          {"camera_ray",
           {{"origin", json(sample.camera_ray.origin)}, {"direction", json(sample.camera_ray.direction)}}},
          {"radiance", json(sample.radiance)},
          {"events", std::move(events)}};
}

std::string pixel_json(const RenderOptions& options, const ExplainedPixel& pixel, Json samples) {
  const Json file = {{"version", LEMMA_VERSION},
                     {"scene", options.scene.scene.string()},
                     {"integrator", options.integrator.name},
                     {"lights", options.lights.name},
                     {"seed", options.settings.seed},
                     {"pixel", {options.pixel->x, options.pixel->y}},
                     {"radiance", json(pixel.radiance)},
                     {"invalid_samples", pixel.invalid_samples},
                     {"samples", std::move(samples)}};
  return file.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";  // file names may be no UTF-8
}

}  // namespace lemma
