#include "integrators/vertex_wave.h"

#include "src/core/instruction_sets.h"

// This file is compiled once for every instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "integrators/vertex_wave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {
namespace {

// Plain loops without branches, that compilers turn into vector code of the instruction set.

template <bool kSmooth>
[[gnu::always_inline]] inline Vec3 shading_normal(const TouchWave& touches, std::size_t i,
                                                  const Vec3& geometric) {
  if constexpr (!kSmooth) return geometric;
  return smooth_normal(touches.normals(i), touches.b1[i], touches.b2[i], touches.direction[i], geometric);
}

template <bool kSmooth>
void find(const TouchWave& touches, std::size_t count, VertexWave& vertices) {
  for (std::size_t i = 0; i < wave_end(count); ++i) {
    const Vec3 direction = touches.direction[i];
    const SurfacePoint point(touches.triangle(i), touches.b1[i], touches.b2[i], direction);
    const Vec3 geometric(point.normal);
    if constexpr (kSmooth) vertices.geometric.set(i, geometric);
    const Frame frame = frame_around(shading_normal<kSmooth>(touches, i, geometric));
    const Vec3 wo = frame.to_local(-direction);
    vertices.query.x.set(i, point.origin);
    vertices.query.n.set(i, frame.n);
    vertices.query.mirror.set(i, frame.to_world({-wo.x, -wo.y, wo.z}));
    vertices.s.set(i, frame.s);
    vertices.t.set(i, frame.t);
    vertices.wo.set(i, wo);
  }
}

void to_local(const VertexWave& vertices, const VecWave& w, std::size_t count, VecWave& local) {
  for (std::size_t i = 0; i < wave_end(count); ++i) local.set(i, vertices.frame(i).to_local(w[i]));
}

void to_world(const VertexWave& vertices, const VecWave& w, std::size_t count, VecWave& world) {
  for (std::size_t i = 0; i < wave_end(count); ++i) world.set(i, vertices.frame(i).to_world(w[i]));
}

void above(const VertexWave& vertices, const VecWave& w, std::size_t count, Wave<std::uint32_t>& is_above) {
  for (std::size_t i = 0; i < wave_end(count); ++i)
    is_above[i] = dot(w[i], vertices.geometric[i]) > 0 ? 1 : 0;
}

}  // namespace

VertexStages vertex_stages() {
  return {find<false>, find<true>, to_local, to_world, above, hwy::TargetName(HWY_TARGET)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lemma {

HWY_EXPORT(vertex_stages);

const std::vector<VertexStages>& all_vertex_stages() {
  static const std::vector<VertexStages> all =
      for_every_instruction_set([] { return HWY_DYNAMIC_DISPATCH(vertex_stages)(); });
  return all;
}

}  // namespace lemma
#endif
