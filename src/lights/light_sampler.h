#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "src/core/named.h"
#include "src/core/pdf.h"
#include "src/core/reflection.h"
#include "src/core/sampler_wave.h"
#include "src/lights/emitter.h"
#include "src/lights/whole_light.h"

namespace lemma {

/// A direction towards a light, chosen from a reference point x: that of a point on an emitter, or of a whole
/// light a direction alone.
struct LightSample {
  Vec3 wi;            // unit
  PdfSolidAngle pdf;  // probability of the light times density of the direction; > 0
  Rgb radiance;       // emitted towards x
  Vec3 to_light;      // from x to the point on the emitter [scene units]; of a whole light the same as wi
  // What blocks the ray x + t to_light hits at t in (0, visible_until).
  float visible_until = std::numeric_limits<float>::infinity();
  std::uint32_t emitter = kNoEmitter;
  // Or the whole light: where visible_until is infinite, the ray may pass it by, and the sample counts if one
  // of its emitters is what the ray meets first.
  const WholeLight* whole = nullptr;
};

/// What a strategy needs to know about a reference point for both sampling and density: found once a point.
/// Who looks from many points keeps one, whose memory then serves them all.
struct LightQuery {
  Vec3 x;
  Vec3 n;                      // unit shading normal: light from below its horizon is not reflected
  Reflection reflection = {};  // what is reflected above it
  // Sums of the emitters' weights up to each block of them (emitter_weights.h), where the strategy weighs
  // them so; else empty.
  std::vector<double> running_weights = {};
};

/// LightQuery of each lane.
struct LightQueryWave {
  VecWave x, n;
  VecWave mirror;                    // of `reflection`, as are ...
  Wave<float> diffuse, peak, width;  // ... these

  [[nodiscard]] LightQuery operator[](std::size_t lane) const {
    return {.x = x[lane],
            .n = n[lane],
            .reflection = {
                .mirror = mirror[lane], .diffuse = diffuse[lane], .peak = peak[lane], .width = width[lane]}};
  }
};

/// LightSample of each lane.
struct LightSampleWave {
  Wave<float> pdf;  // [sr^-1]; 0: there is no sample, and the rest means nothing
  VecWave wi, to_light;
  RgbWave radiance;
  Wave<float> visible_until;
  Wave<std::uint32_t> emitter;
  Wave<const WholeLight*> whole;

  void set(std::size_t lane, const LightSample& sample) {
    pdf[lane] = sample.pdf.value;
    wi.set(lane, sample.wi), to_light.set(lane, sample.to_light), radiance.set(lane, sample.radiance);
    visible_until[lane] = sample.visible_until, emitter[lane] = sample.emitter, whole[lane] = sample.whole;
  }
};

/// What a LightSampler does for single points, for the first `count` lanes of a wave: the same, bit for bit.
class LightWaveSampler {
 public:
  LightWaveSampler() = default;
  LightWaveSampler(const LightWaveSampler&) = delete;
  LightWaveSampler& operator=(const LightWaveSampler&) = delete;
  virtual ~LightWaveSampler() = default;

  /// @param u  what LightSampler::sample() would draw, by Sampler::next_partner_pair() alone
  virtual void sample_wave(const LightQueryWave& at, std::size_t count, const ChoicePairWave& u,
                           LightSampleWave& samples) const = 0;

  virtual void pdf_wave(const LightQueryWave& at, std::size_t count, const Wave<std::uint32_t>& emitter,
                        const VecWave& y, Wave<float>& pdf) const = 0;
};

/// Chooses directions to emitters. The technique is: choose a light (an emitter, or emitters that are sampled
/// as one), then a direction towards it; it counts only if what x sees there is that light. The density of a
/// direction is therefore that of the one light it hits first, without a sum over lights behind it, and the
/// weights of multiple importance sampling sum to 1 also where emitters overlap. All densities end in solid
/// angle about x.
class LightSampler {
 public:
  LightSampler() = default;
  LightSampler(const LightSampler&) = delete;
  LightSampler& operator=(const LightSampler&) = delete;
  virtual ~LightSampler() = default;

  /// Makes room in a query for what prepare() finds, so that it needs no memory. None, by default.
  virtual void reserve(LightQuery&) const {}

  /// Finds what else the query holds. Nothing, by default.
  virtual void prepare(LightQuery&) const {}

  /// Makes `at` the query of a point, prepared.
  void look_from(const Vec3& x, const Vec3& n, const Reflection& reflection, LightQuery& at) const {
    at.x = x;
    at.n = n;
    at.reflection = reflection;
    prepare(at);
  }

  /// A query of a point, prepared; one that reflects alike in all directions unless told.
  [[nodiscard]] LightQuery query(const Vec3& x, const Vec3& n, const Reflection& reflection = {}) const {
    LightQuery at;
    look_from(x, n, reflection, at);
    return at;
  }

  /// @param at  prepared
  /// @return nothing if the emitter chosen does not emit towards x
  [[nodiscard]] virtual std::optional<LightSample> sample(const LightQuery& at, Sampler& random) const = 0;

  /// The whole light that an emitter is a part of, or null.
  [[nodiscard]] virtual const WholeLight* whole_of(std::uint32_t) const { return nullptr; }

  /// For waves of points, or null.
  [[nodiscard]] virtual const LightWaveSampler* waves() const { return nullptr; }

  /// Density with which sample() returns the direction from at.x to the point `y` of the emitter.
  /// @param y  on the emitter, up to rounding
  [[nodiscard]] virtual PdfSolidAngle pdf(const LightQuery& at, std::uint32_t emitter,
                                          const Vec3& y) const = 0;
};

/// Of the emitters of a scene; `triangles` are all of it, or empty if there is nothing else.
using LightSamplerFactory = std::unique_ptr<const LightSampler> (*)(std::span<const Emitter> emitters,
                                                                    std::span<const Triangle> triangles);

/// All strategies by the name users give them.
[[nodiscard]] std::span<const Named<LightSamplerFactory>> light_samplers();

}  // namespace lemma
