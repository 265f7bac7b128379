#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "integrators/path_record.h"
#include "integrators/vertex.h"
#include "src/lights/light_sampler.h"

namespace lemma {

/// The observer that integrators have while they render: it sees nothing, and its calls vanish in compiling.
struct NoObserver {
  static constexpr bool kRecords = false;

  template <class... Any>
  void surface(const Any&...) {}
  template <class... Any>
  void light(const Any&...) {}
  template <class... Any>
  void scatter(const Any&...) {}
  template <class... Any>
  void emitter(const Any&...) {}
  void choice(bool, float) {}
  void roulette(float, bool, const Rgb&) {}
  void end(PathEnd) {}
};

/// The observer that writes down the events of one path.
class PathRecorder {
 public:
  static constexpr bool kRecords = true;

  using Strategies = std::span<const std::unique_ptr<const LightSampler>>;

  /// @param strategies  the light samplings whose densities are told, besides the one that is rendered with
  PathRecorder(const Scene& scene, Strategies strategies) : scene_(scene), strategies_(strategies) {}

  [[nodiscard]] std::vector<PathEvent> take_events() { return std::exchange(events_, {}); }

  template <Model M>
  void surface(const Hit& hit, const Vertex<M>& vertex, const Rgb& throughput) {
    add_surface(hit, {vertex.origin(), vertex.shading_normal(), vertex.reflection()}, throughput);
  }

  template <Model M>
  void light(const Vertex<M>& vertex, const std::optional<LightSample>& sample, LightFate fate, float weight,
             const Rgb& contribution) {
    LightEvent event{.fate = fate, .weight = weight, .contribution = contribution};
    if (sample) {
      const auto [f_cos, pdf] = vertex.at(sample->wi);
      event.f_cos = f_cos;
      event.densities.brdf = pdf.value;
    }
    add_light(sample, std::move(event));
  }

  void scatter(const std::optional<ScatterSample>& next);
  void emitter(const Hit& hit, const Rgb& radiance, PdfSolidAngle pdf_brdf, float weight,
               const Rgb& contribution);
  void choice(bool light, float probability);
  void roulette(float survival, bool survived, const Rgb& throughput);
  void end(PathEnd why);

 private:
  /// Where directions leave, with the shading normal there and what is reflected.
  struct Place {
    Vec3 x, n;
    Reflection reflection;
  };

  void add_surface(const Hit& hit, const Place& place, const Rgb& throughput);
  void add_light(const std::optional<LightSample>& sample, LightEvent event);

  /// Of the direction from the last surface to a point of an emitter; none from the camera.
  [[nodiscard]] std::vector<float> light_densities(std::uint32_t emitter, const Vec3& y) const;

  const Scene& scene_;
  Strategies strategies_;
  std::optional<Place> from_;
  std::vector<PathEvent> events_;
};

}  // namespace lemma
