#include "src/shading/phong_wave.h"
namespace lemma {
namespace {
Material m_of(const MaterialWave& m, std::size_t i, Lobe lobe, LobeSampling s) {
  Material r;
  r.kd = m.kd[i];
  r.ks = m.ks[i];
  r.exponent = m.exponent[i];
  r.lobe = lobe;
  r.sampling = s;
  r.specular_factor = m.specular_factor[i];
  r.diffuse_probability = m.diffuse_probability[i];
  return r;
}
template <bool S, Lobe L, LobeSampling P>
void at(const MaterialWave& m, const VecWave& wo, const VecWave& wi, std::size_t n, BrdfValueWave& v) {
  for (std::size_t i = 0; i < n; ++i) {
    const Material x = m_of(m, i, L, P);
    const auto r = Phong<S>(x).at(wo[i], wi[i]);
    v.f.set(i, r.f);
    v.pdf[i] = r.pdf.value;
  }
}
template <bool S, Lobe L, LobeSampling P>
void sample(const MaterialWave& m, const VecWave& wo, const ChoicePairWave& u, std::size_t n,
            BrdfSampleWave& v) {
  for (std::size_t i = 0; i < n; ++i) {
    const Material x = m_of(m, i, L, P);
    std::optional<BrdfSample> r;
    if constexpr (S)
      r = Phong<S>(x).sample(wo[i], Sampler::ChoicePair{u.x[i], u.y[i]});
    else
      r = Phong<S>(x).sample(wo[i], 0, Vec2(static_cast<float>(u.x[i]), u.y[i]));
    v.pdf[i] = 0;
    if (r) {
      v.wi.set(i, r->wi);
      v.pdf[i] = r->pdf.value;
      v.weight.set(i, r->weight);
    }
  }
}
}  // namespace
std::vector<PhongWaves> all_phong_waves(bool s, Lobe lobe, LobeSampling sampling) {
  constexpr Lobe P = Lobe::phong, B = Lobe::blinn_phong;
  constexpr LobeSampling T = LobeSampling::truncated, Q = LobeSampling::p6;
  if (!s) return {{at<false, P, T>, sample<false, P, T>, "path by path"}};
  if (lobe == B) return {{at<true, B, T>, sample<true, B, T>, "path by path"}};
  if (sampling == T) return {{at<true, P, T>, sample<true, P, T>, "path by path"}};
  return {{at<true, P, Q>, sample<true, P, Q>, "path by path"}};
}
}  // namespace lemma
