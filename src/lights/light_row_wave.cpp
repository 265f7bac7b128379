#include "src/lights/light_row.h"
#include "src/lights/whole_core.h"
#include "src/lights/whole_view.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/lights/light_row_wave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

// Plain loops over lanes without branches, that compilers turn into vector code of the instruction set. Those
// that fetch what lanes have of different lights are loops of their own.

using Scratch = LightRowScratch;

[[gnu::always_inline]] inline Reflection reflection_of(const LightQueryWave& at, std::size_t i) {
  return {at.mirror[i], at.diffuse[i], at.peak[i], at.width[i]};
}

[[gnu::always_inline]] inline Vec3d centre_of(const Scratch& s, std::size_t i) {
  return {s.centre_x[i], s.centre_y[i], s.centre_z[i]};
}

[[gnu::always_inline]] inline Triangle triangle_of(const VecWave& v0, const VecWave& v1, const VecWave& v2,
                                                   std::size_t i) {
  return {v0[i], v1[i], v2[i]};
}

/// Where no lane of a step reflects by a lobe, weights without one have the same bits.
void find_lobes(const LightQueryWave& at, std::size_t end, Scratch& s) {
  for (std::size_t begin = 0; begin < end; begin += kWaveStep) {
    std::uint32_t lobes = 0;
    for (std::size_t i = begin; i < begin + kWaveStep; ++i) lobes |= at.peak[i] != 0 ? 1u : 0u;
    s.has_lobes[begin / kWaveStep] = lobes != 0;
  }
}

template <bool kLobes>
void weigh_whole_step(const WholeOutline& outline, const LightQueryWave& at, std::size_t begin,
                      Wave<double>& weights, Wave<std::uint32_t>& undone) {
#pragma GCC ivdep
  for (std::size_t i = begin; i < begin + kWaveStep; ++i) {
    const Reflection reflection =
        kLobes ? reflection_of(at, i) : Reflection{.diffuse = at.diffuse[i], .peak = 0};
    const float weight = whole_weight(outline, at.x[i], at.n[i], reflection);
    weights[i] = weight;
    undone[i] |= weight >= 0 ? 0u : 1u;
  }
}

void weigh_whole(const LightRow::Light& light, const LightQueryWave& at, std::size_t end, Scratch& s,
                 Wave<double>& weights) {
  for (std::size_t begin = 0; begin < end; begin += kWaveStep) {
    const auto weigh_step = s.has_lobes[begin / kWaveStep] ? weigh_whole_step<true> : weigh_whole_step<false>;
    weigh_step(light.outline, at, begin, weights, s.undone);
  }
}

/// As LightTree::importance().
void weigh_quad(const LightRow::Light& light, const LightQueryWave& at, std::size_t end, Scratch& s,
                Wave<double>& weights) {
  const EmitterView view = light.quad->view();
  const LightImportance importance = light.importance;
#pragma GCC ivdep
  for (std::size_t i = 0; i < end; ++i) {
    const Vec3 x = at.x[i];
    const Reflection reflection = reflection_of(at, i);
    const float reflected = importance.reflected(x, reflection);
    weights[i] =
        view.far_importance(x, at.n[i]) * double{reflection.peak == 0 ? reflection.diffuse : reflected};
    s.undone[i] |= view.is_far(x) ? 0u : 1u;
  }
}

/// Whether a single light is far enough to be sampled as one, if it is a quad.
void check_single(const LightRow::Light& light, const LightQueryWave& at, std::size_t end,
                  Wave<std::uint32_t>& undone) {
  if (light.quad == nullptr) return;
  const EmitterView view = light.quad->view();
  for (std::size_t i = 0; i < end; ++i) undone[i] = view.is_far(at.x[i]) ? 0u : 1u;
}

void weigh(const LightRow& row, const LightQueryWave& at, std::size_t end, Scratch& s) {
  for (std::size_t i = 0; i < end; ++i) s.undone[i] = 0, s.sum[i] = 0;
  if (row.is_single) return check_single(row.lights.front(), at, end, s.undone);
  find_lobes(at, end, s);
  for (std::size_t k = 0; k < row.lights.size(); ++k) {
    const auto weigh_light = row.lights[k].whole != nullptr ? weigh_whole : weigh_quad;
    weigh_light(row.lights[k], at, end, s, s.weight[k]);
    for (std::size_t i = 0; i < end; ++i) s.sum[i] += s.weight[k][i];
  }
}

/// As LightTree::choose().
void choose(const LightRow& row, std::size_t end, const Wave<double>& u, Scratch& s) {
  constexpr double below_one = 1 - 0x1p-53;
  for (std::size_t i = 0; i < end; ++i) {
    s.target[i] = u[i] * s.sum[i], s.own[i] = 1, s.chosen[i] = 0, s.is_chosen[i] = 0;
  }
  for (std::uint32_t k = 0; k < row.lights.size(); ++k) {
    const Wave<double>& weight = s.weight[k];
    for (std::size_t i = 0; i < end; ++i) {
      const bool before = s.is_chosen[i] != 0, now = !before & (s.target[i] < weight[i]);
      s.target[i] -= before | now ? 0 : weight[i];
      s.own[i] = now ? weight[i] : s.own[i];
      s.chosen[i] = now ? k : s.chosen[i];
      s.is_chosen[i] = before | now ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < end; ++i) {
    const bool can_choose = s.sum[i] > 0;
    s.undone[i] |= can_choose & (s.is_chosen[i] == 0) ? 1u : 0u;  // rounding led past all
    s.is_chosen[i] = can_choose ? 1 : 0;
    s.u[i] = std::min(std::max(s.target[i] / s.own[i], 0.0), below_one);
    s.pmf[i] = s.own[i] / s.sum[i];
  }
}

void choose_single(std::size_t end, const Wave<double>& u, Scratch& s) {
  for (std::size_t i = 0; i < end; ++i) s.u[i] = u[i], s.pmf[i] = 1, s.chosen[i] = 0, s.is_chosen[i] = 1;
}

void fetch_whole(const LightRow::Light& light, std::size_t i, Scratch& s) {
  const Vec3d& centre = light.whole->centre;
  s.centre_x[i] = centre.x, s.centre_y[i] = centre.y, s.centre_z[i] = centre.z;
  s.radius[i] = light.whole->radius;
  s.core[i] = light.whole->core, s.shell[i] = light.whole->shell;
}

void fetch_emitter(const Triangle& t, std::size_t i, Scratch& s) {
  s.v0.set(i, t.v0), s.v1.set(i, t.v1), s.v2.set(i, t.v2);
}

/// Number that samples of a quad are made of, as single ones.
[[gnu::always_inline]] inline Vec2 quad_number(double u, float v) {
  return {std::min(static_cast<float>(u), 1 - 0x1p-24f), v};
}

void fetch_lights(const LightRow& row, std::size_t count, const ChoicePairWave& u, Scratch& s,
                  LightSampleWave& samples) {
  for (std::size_t i = 0; i < count; ++i) {
    const LightRow::Light& light = row.lights[s.chosen[i]];
    samples.whole[i] = light.whole;
    samples.radiance.set(i, light.radiance);
    s.is_whole[i] = light.whole != nullptr ? 1 : 0;
    if (light.whole != nullptr) {
      fetch_whole(light, i, s);
      samples.emitter[i] = kNoEmitter;
    } else {
      const std::size_t half = QuadLight::half_of(quad_number(s.u[i], u.y[i]));
      const Triangle& triangle = light.quad->halves()[half];
      const std::uint32_t emitter = light.quad->emitters()[half];
      s.half[i] = static_cast<std::uint32_t>(half);
      s.half_v0.set(i, triangle.v0), s.half_v1.set(i, triangle.v1), s.half_v2.set(i, triangle.v2);
      s.area_density[i] = light.quad->densities()[emitter == light.quad->emitters()[0] ? 0 : 1];
      fetch_emitter(row.emitters[emitter].shape, i, s);
      samples.emitter[i] = emitter;
      samples.radiance.set(i, row.emitters[emitter].radiance);
    }
  }
}

/// Whether the lobe of a lane of the step from `begin` on may serve to sample its light; else LobeSector()
/// has the bits of all, which does not.
bool may_need_lobes(const LightQueryWave& at, const Scratch& s, std::size_t begin) {
  constexpr float more =
      1.001f;  // cones are found in float32, but near right angles not less right than this
  std::uint32_t lobes = 0;
  for (std::size_t i = begin; i < begin + kWaveStep; ++i) {
    const Vec3 to_centre(centre_of(s, i) - Vec3d(at.x[i]));
    const auto radius = static_cast<float>(s.radius[i]);
    const float sin2 = radius * radius / dot(to_centre, to_centre);
    const float one_minus_cos = sin2 / (1 + std::sqrt(std::max(1 - sin2, 0.0f)));
    lobes |= LobeSector::may_serve(at.peak[i], at.width[i], more * one_minus_cos) ? 1u : 0u;
  }
  return lobes != 0;
}

template <bool kLobes>
[[gnu::always_inline]] inline WholeView view_of(const LightQueryWave& at, const SphereCone& cone,
                                                std::size_t i) {
  if constexpr (kLobes) return {cone, LobeSector(reflection_of(at, i), cone)};
  return {cone, LobeSector()};
}

template <bool kLobes>
void sample_wholes_step(const LightQueryWave& at, std::size_t begin, const Wave<float>& v, Scratch& s,
                        LightSampleWave& samples) {
#pragma GCC ivdep
  for (std::size_t i = begin; i < begin + kWaveStep; ++i) {
    const SphereCone cone(centre_of(s, i), s.radius[i], at.x[i]);
    const WholeView seen = view_of<kLobes>(at, cone, i);
    const auto [within, w] = seen.sample(s.u[i], v[i]);
    const float pdf = seen.pdf(s.pmf[i], w).value;
    const Vec3 wi(w);
    s.undone[i] |= (s.is_whole[i] != 0) & !cone.can_be_sampled() ? 1u : 0u;
    samples.pdf[i] = within & (pdf > 0) ? pdf : 0;
    samples.wi.x[i] = wi.x, samples.wi.y[i] = wi.y, samples.wi.z[i] = wi.z;
    samples.to_light.x[i] = wi.x, samples.to_light.y[i] = wi.y, samples.to_light.z[i] = wi.z;
  }
}

void find_visible_until(const LightQueryWave& at, std::size_t end, const Scratch& s,
                        LightSampleWave& samples) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < end; ++i) {
    samples.visible_until[i] =
        WholeCore{centre_of(s, i), s.core[i], s.shell[i]}.visible_until(at.x[i], samples.wi[i]);
  }
}

void sample_wholes(const LightQueryWave& at, std::size_t end, const Wave<float>& v, Scratch& s,
                   LightSampleWave& samples) {
  for (std::size_t begin = 0; begin < end; begin += kWaveStep) {
    const auto sample_step =
        may_need_lobes(at, s, begin) ? sample_wholes_step<true> : sample_wholes_step<false>;
    sample_step(at, begin, v, s, samples);
  }
  find_visible_until(at, end, s, samples);
}

/// Of the lanes that have chosen a quad.
void sample_quads(const LightQueryWave& at, std::size_t end, const Wave<float>& v, const Scratch& s,
                  LightSampleWave& samples) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < end; ++i) {
    const Vec3 x = at.x[i];
    const Triangle emitter = triangle_of(s.v0, s.v1, s.v2, i);
    const Vec3d y = QuadLight::point_in(triangle_of(s.half_v0, s.half_v1, s.half_v2, i), s.half[i],
                                        quad_number(s.u[i], v[i]));
    const auto [exists, connection] = possible_connection(emitter, x, y);
    const float pdf = QuadLight::pdf(s.pmf[i], s.area_density[i], connection).value;
    const Vec3 wi(normalize(connection.to_light)), to_light(connection.to_light);
    const float until = visible_until(emitter, x, connection);
    const bool other = s.is_whole[i] != 0;
    const auto put = [i, other](Wave<float>& to, float value) { to[i] = other ? to[i] : value; };
    put(samples.pdf, exists & (pdf > 0) ? pdf : 0);
    put(samples.wi.x, wi.x), put(samples.wi.y, wi.y), put(samples.wi.z, wi.z);
    put(samples.to_light.x, to_light.x), put(samples.to_light.y, to_light.y);
    put(samples.to_light.z, to_light.z);
    put(samples.visible_until, until);
  }
}

struct Kinds {
  bool wholes = false, quads = false;
};

Kinds kinds_of(const LightRow& row) {
  Kinds kinds;
  for (const LightRow::Light& light : row.lights)
    (light.whole != nullptr ? kinds.wholes : kinds.quads) = true;
  return kinds;
}

void sample(const LightRow& row, const LightQueryWave& at, std::size_t count, const ChoicePairWave& u,
            Scratch& s, LightSampleWave& samples) {
  const std::size_t end = wave_end(count);
  weigh(row, at, end, s);
  if (row.is_single) {
    choose_single(end, u.x, s);
  } else {
    choose(row, end, u.x, s);
  }
  fetch_lights(row, count, u, s, samples);
  const Kinds kinds = kinds_of(row);
  if (kinds.wholes) sample_wholes(at, end, u.y, s, samples);
  if (kinds.quads) sample_quads(at, end, u.y, s, samples);
  for (std::size_t i = 0; i < end; ++i) samples.pdf[i] = s.is_chosen[i] != 0 ? samples.pdf[i] : 0;
}

/// As LightTree::choice_of(), once all are weighed.
void find_probabilities(const LightRow& row, std::size_t end, Scratch& s) {
  if (row.is_single) {
    for (std::size_t i = 0; i < end; ++i) s.pmf[i] = 1;
    return;
  }
  for (std::size_t i = 0; i < end; ++i) s.own[i] = 0;
  for (std::uint32_t k = 0; k < row.lights.size(); ++k) {
    for (std::size_t i = 0; i < end; ++i) s.own[i] = s.chosen[i] == k ? s.weight[k][i] : s.own[i];
  }
  for (std::size_t i = 0; i < end; ++i) s.pmf[i] = s.own[i] == 0 ? 0 : s.own[i] / s.sum[i];
}

void fetch_emitters(const LightRow& row, std::size_t count, const Wave<std::uint32_t>& emitter, Scratch& s) {
  for (std::size_t i = 0; i < count; ++i) {
    s.chosen[i] = row.light_of[emitter[i]];
    const LightRow::Light& light = row.lights[s.chosen[i]];
    fetch_emitter(row.emitters[emitter[i]].shape, i, s);
    s.is_whole[i] = light.whole != nullptr ? 1 : 0;
    if (light.whole != nullptr) {
      fetch_whole(light, i, s);
    } else {
      s.area_density[i] = light.quad->densities()[emitter[i] == light.quad->emitters()[0] ? 0 : 1];
    }
  }
}

[[gnu::always_inline]] inline PossibleConnection connection_of(const LightQueryWave& at, const Scratch& s,
                                                               const VecWave& y, std::size_t i) {
  return possible_connection(triangle_of(s.v0, s.v1, s.v2, i), at.x[i], Vec3d(y[i]));
}

template <bool kLobes>
void find_pdf_of_wholes_step(const LightQueryWave& at, std::size_t begin, const VecWave& y, Scratch& s,
                             Wave<float>& pdf) {
#pragma GCC ivdep
  for (std::size_t i = begin; i < begin + kWaveStep; ++i) {
    const auto [exists, connection] = connection_of(at, s, y, i);
    const SphereCone cone(centre_of(s, i), s.radius[i], at.x[i]);
    const float value = view_of<kLobes>(at, cone, i).pdf(s.pmf[i], connection.to_light).value;
    s.undone[i] |= (s.is_whole[i] != 0) & !cone.can_be_sampled() ? 1u : 0u;
    pdf[i] = exists ? value : 0;
  }
}

void find_pdf_of_wholes(const LightQueryWave& at, std::size_t end, const VecWave& y, Scratch& s,
                        Wave<float>& pdf) {
  for (std::size_t begin = 0; begin < end; begin += kWaveStep) {
    const auto find_step =
        may_need_lobes(at, s, begin) ? find_pdf_of_wholes_step<true> : find_pdf_of_wholes_step<false>;
    find_step(at, begin, y, s, pdf);
  }
}

/// Of the lanes that hit a quad.
void find_pdf_of_quads(const LightQueryWave& at, std::size_t end, const VecWave& y, const Scratch& s,
                       Wave<float>& pdf) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < end; ++i) {
    const auto [exists, connection] = connection_of(at, s, y, i);
    const float value = QuadLight::pdf(s.pmf[i], s.area_density[i], connection).value;
    pdf[i] = s.is_whole[i] != 0 ? pdf[i] : exists ? value : 0;
  }
}

void find_pdf(const LightRow& row, const LightQueryWave& at, std::size_t count,
              const Wave<std::uint32_t>& emitter, const VecWave& y, Scratch& s, Wave<float>& pdf) {
  const std::size_t end = wave_end(count);
  fetch_emitters(row, count, emitter, s);
  weigh(row, at, end, s);
  find_probabilities(row, end, s);
  const Kinds kinds = kinds_of(row);
  if (kinds.wholes) find_pdf_of_wholes(at, end, y, s, pdf);
  if (kinds.quads) find_pdf_of_quads(at, end, y, s, pdf);
}

}  // namespace

LightRowWaves row_waves() {
  return {sample, find_pdf};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {
namespace {

HWY_EXPORT(row_waves);

}  // namespace

LightRowWaves light_row_waves() {
  return HWY_DYNAMIC_DISPATCH(row_waves)();
}

}  // namespace lemma
#endif
