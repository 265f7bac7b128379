#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "src/core/rgb.h"
#include "src/core/vec.h"
#include "src/lights/emitter.h"

namespace lemma {

/// What became of a light sample.
enum class LightFate {
  none,     // the light chosen sends nothing to the point
  below,    // the surface does not reflect from that direction
  covered,  // another emitter lies on top of the point chosen
  hidden,   // something is in between
  missed,   // the direction to a round light meets something else
  seen
};

/// Densities of one direction [sr^-1].
struct Densities {
  float brdf = 0;
  std::vector<float> light{};  // by each light sampling of light_samplers(); empty: not towards an emitter
};

// What happens on a path, in order. Densities of a direction are those at the surface that it leaves.

/// A surface is met that scatters.
struct SurfaceEvent {
  std::uint32_t triangle = 0, material = 0;
  Vec3 position{0, 0, 0}, normal{0, 0, 0};  // world space; the shading normal, on the side of the path
  Rgb throughput{};                         // of the path up to here [1]
};

/// A light sample is taken there.
struct LightEvent {
  LightFate fate = LightFate::none;
  // Index into Scene::emitters; kNoEmitter for a direction to a round light that did not meet it, which has
  // no distance and densities of light either. Like what follows of no meaning if there is no sample.
  std::uint32_t emitter = kNoEmitter;
  Vec3 wi{0, 0, 0};         // unit
  float distance = 0;       // [scene units]
  Rgb radiance{}, f_cos{};  // emitted towards the surface [W m^-2 sr^-1]; f cos(theta_i) [sr^-1]
  Densities densities{};
  float pdf = 0, weight = 0;  // density it was drawn with [sr^-1]; its weight, 0 if it does not count
  Rgb contribution{};         // to the radiance of the camera ray
};

/// A direction is drawn by the BRDF there.
struct ScatterEvent {
  bool absorbed = false;  // none was
  Vec3 wi{0, 0, 0};
  float pdf = 0;
  Rgb weight{};  // f cos(theta_i) / pdf [1]
};

/// A direction of the camera or the BRDF meets an emitter.
struct EmitterEvent {
  std::uint32_t emitter = 0;
  Rgb radiance{};  // towards where the direction comes from
  Densities densities{};
  float weight = 0;
  Rgb contribution{};
};

/// One of two directions is chosen to go on with.
struct ChoiceEvent {
  bool light = false;  // the light sample's, not the BRDF's
  float probability = 0;
};

struct RouletteEvent {
  float survival = 0;  // probability
  bool survived = false;
  Rgb throughput{};  // of the path that goes on
};

enum class PathEnd {
  escaped,  // no surface in the direction
  cut,      // the depth limit
  done      // no direction meets a surface that scatters
};

struct EndEvent {
  PathEnd why = PathEnd::escaped;
};

using PathEvent =
    std::variant<SurfaceEvent, LightEvent, ScatterEvent, EmitterEvent, ChoiceEvent, RouletteEvent, EndEvent>;

}  // namespace lemma
