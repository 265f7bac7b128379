#include "integrators/path_wave.h"

#include "integrators/emission.h"
#include "src/scene/scene.h"

namespace lemma {
namespace {

/// A direction that glass sends a path on with.
ScatterSample glass_sample(const Scene& scene, const Ray& ray, const Hit& hit, Sampler& random) {
  constexpr Model flat{.textures = true, .glass = true},
      smooth{.smooth_normals = true, .textures = true, .glass = true};
  if (scene.needs.model.smooth_normals) return Vertex<smooth>(scene, ray, hit).sample(random).value();
  return Vertex<flat>(scene, ray, hit).sample(random).value();
}

}  // namespace

PathWave::PathWave(const WaveTechnique& technique, const World& world)
    : technique_(technique),
      world_(world),
      lights_(world.lights.waves()),
      phong_(all_phong_waves(technique.model.specular, world.scene.materials.front().lobe,
                             world.scene.materials.front().sampling)
                 .front()),
      vertex_stages_(all_vertex_stages().front()),
      weight_stages_(all_weight_stages().front()) {
  for (std::size_t i = 0; i < kWaveSize; ++i) {
    rays_.t_max[i] = std::numeric_limits<float>::infinity();
    const Reflection alike_everywhere;
    vertices_.query.diffuse[i] = alike_everywhere.diffuse;
    vertices_.query.peak[i] = alike_everywhere.peak;
    vertices_.query.width[i] = alike_everywhere.width;
  }
  if (technique.model.glass) from_glass_.reserve(kWaveSize);
  if (lights_ == nullptr) {
    queries_.resize(kWaveSize);
    for (LightQuery& query : queries_) world.lights.reserve(query);
  }
}

void PathWave::radiances(const RayWave& rays, const HitWave& first, std::size_t count, Tracer& tracer,
                         const SamplerWave& random, RgbWave& radiance) {
  for (std::size_t i = 0; i < count; ++i) radiance.set(i, {});
  start(rays, first, count, random);
  for (depth_ = 1; count_ > 0; ++depth_) {
    split_hits();
    add_emission(radiance);
    if (depth_ > technique_.options.max_depth) {
      tracer.counts.paths_cut += surfaces_.count() + glass_.count();
      return;
    }
    if (technique_.model.glass) pass_glass();
    find_vertices();
    if (technique_.weighting != Weighting::brdf) add_lights(tracer, radiance);
    scatter();
    go_on(tracer);
  }
}

void PathWave::start(const RayWave& rays, const HitWave& first, std::size_t count,
                     const SamplerWave& random) {
  count_ = count;
  for (std::size_t i = 0; i < count; ++i) {
    id_[i] = static_cast<std::uint32_t>(i);
    throughput_.set(i, {1, 1, 1});
  }
  random_ = random;
  rays_.origin = rays.origin, rays_.direction = rays.direction;
  hits_ = first;
}

/// Those on emitters and those that go on; the others met nothing.
void PathWave::split_hits() {
  if (technique_.model.overlays) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (hits_.is_hit(i)) hits_.set(i, top_of(world_.scene, rays_[i], hits_[i]));
    }
  }
  emitters_.clear(), glass_.clear(), surfaces_.clear();
  for (std::size_t i = 0; i < count_; ++i) {
    const bool hit = hits_.is_hit(i);
    emitter_[i] = world_.scene.facets[hit ? hits_.triangle[i] : 0].emitter;
    const bool emits = emitter_[i] != kNoEmitter;
    emitters_.add_if(hit && emits, i);
    const bool scatters = hit && (!emits || technique_.options.emitters_reflect);
    const bool glass = scatters && technique_.model.glass && is_glass(world_.scene, hits_.triangle[i]);
    glass_.add_if(glass, i);
    surfaces_.add_if(scatters && !glass, i);
  }
}

void PathWave::add_emission(RgbWave& radiance) {
  if (depth_ > 1) weigh_emission();
  for (std::size_t k = 0; k < emitters_.count(); ++k) {
    const std::size_t i = emitters_[k];
    // No light sample could have found what the camera sees directly.
    const float weight = depth_ == 1 ? 1.0f : emission_.weight[k];
    const Rgb emission = emitted(world_.scene.emitters[emitter_[i]], rays_.origin[i]);
    radiance.set(id_[i], radiance[id_[i]] + throughput_[i] * emission * weight);
  }
}

void PathWave::weigh_emission() {
  const LaneList& lanes = emitters_;
  const std::size_t count = lanes.count();
  const bool by_both = technique_.weighting == Weighting::power || technique_.weighting == Weighting::balance;
  if (by_both) {
    lanes.gather(emitter_, emission_.emitter);
    for (std::size_t k = 0; k < count; ++k) {
      const Hit hit = hits_[lanes[k]];
      emission_.y.set(k, Vec3(point_at(world_.scene.triangles[hit.triangle], hit.b1, hit.b2)));
    }
    if (lights_ != nullptr) {
      const LightQueryWave& at = vertices_.query;
      lanes.gather(at.x, emission_.from.x), lanes.gather(at.n, emission_.from.n);
      lanes.gather(at.mirror, emission_.from.mirror);
      lanes.gather(at.diffuse, emission_.from.diffuse);
      lanes.gather(at.peak, emission_.from.peak);
      lanes.gather(at.width, emission_.from.width);
      lights_->pdf_wave(emission_.from, count, emission_.emitter, emission_.y, emission_.pdf_light);
    } else {
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = lanes[k];
        emission_.pdf_light[k] = 0;
        if (std::isinf(pdf_brdf_[i])) continue;  // glass, which has no query
        emission_.pdf_light[k] =
            world_.lights.pdf(queries_[id_[i]], emission_.emitter[k], emission_.y[k]).value;
      }
    }
  }
  lanes.gather(pdf_brdf_, emission_.pdf_brdf);
  weight_stages_.emission(technique_.weighting, emission_.pdf_brdf, emission_.pdf_light, count,
                          emission_.weight);
}

/// Mirrors and refracts the paths that meet glass, where no light is sampled.
void PathWave::pass_glass() {
  from_glass_.clear();
  for (std::size_t k = 0; k < glass_.count(); ++k) {
    const std::size_t i = glass_[k];
    GlassPath path{id_[i], throughput_[i], random_[i], {}};
    const ScatterSample next = glass_sample(world_.scene, rays_[i], hits_[i], path.random);
    path.ray = {next.origin, next.wi};
    path.throughput *= next.weight;
    const float q = survival(technique_.options.roulette, depth_, path.throughput);
    if (survives(q, path.throughput, path.random)) from_glass_.push_back(path);
  }
}

void PathWave::find_vertices() {
  const LaneList& lanes = surfaces_;
  const std::size_t count = lanes.count();
  lanes.keep(id_), lanes.keep(throughput_), random_.keep(lanes);
  for (std::size_t k = 0; k < count; ++k) {
    const Hit hit = hits_[lanes[k]];
    touches_.set_triangle(k, world_.scene.triangles[hit.triangle]);
    touches_.b1[k] = hit.b1, touches_.b2[k] = hit.b2;
    if (technique_.model.smooth_normals) touches_.set_normals(k, world_.scene.normals[hit.triangle]);
    if (technique_.model.textures) {
      set_material(k, textured_material(world_.scene, hit));
    } else {
      set_material(k, world_.scene.materials[material_index(world_.scene, hit)]);
    }
  }
  lanes.gather(rays_.direction, touches_.direction);
  count_ = count;
  const auto find = technique_.model.smooth_normals ? vertex_stages_.find_smooth : vertex_stages_.find_flat;
  find(touches_, count_, vertices_);
}

void PathWave::set_material(std::size_t lane, const Material& material) {
  if (!technique_.model.specular) return vertices_.materials.kd.set(lane, material.kd);
  vertices_.materials.set(lane, material);
  vertices_.query.diffuse[lane] = material.outline.diffuse;
  vertices_.query.peak[lane] = material.outline.peak;
  vertices_.query.width[lane] = material.outline.width;
}

void PathWave::add_lights(Tracer& tracer, RgbWave& radiance) {
  sample_lights();
  vertex_stages_.to_local(vertices_, samples_.wi, count_, local_);
  phong_.at(vertices_.materials, vertices_.wo, local_, count_, brdf_);
  weight_stages_.light(technique_.weighting, samples_, brdf_, local_, throughput_, count_, reflected_);
  if (technique_.model.smooth_normals) keep_above(samples_.wi, reflected_.reflects);
  trace_lights(tracer, radiance);
}

void PathWave::sample_lights() {
  if (lights_ == nullptr) return sample_lights_one_by_one();
  random_.draw_partner_pairs(count_, pairs_);
  lights_->sample_wave(vertices_.query, count_, pairs_, samples_);
}

void PathWave::sample_lights_one_by_one() {
  for (std::size_t i = 0; i < count_; ++i) {
    LightQuery& query = queries_[id_[i]];
    const LightQuery point = vertices_.query[i];
    world_.lights.look_from(point.x, point.n, point.reflection, query);
    Sampler random = random_[i];
    const std::optional<LightSample> sample = world_.lights.sample(query, random);
    random_.set(i, random);
    samples_.pdf[i] = 0;
    if (sample) samples_.set(i, *sample);
  }
}

/// Adds what the lights contribute that are seen.
void PathWave::trace_lights(Tracer& tracer, RgbWave& radiance) {
  whole_.clear(), points_.clear();
  for (std::size_t i = 0; i < count_; ++i) {
    const bool reflects = reflected_.reflects[i] != 0;
    const bool whole = may_pass_by(samples_.whole[i], samples_.visible_until[i]);
    whole_.add_if(reflects && whole, i);
    points_.add_if(reflects && !whole && is_uncovered(i), i);
  }
  trace_whole_lights(tracer, radiance);
  points_.gather(vertices_.query.x, shadow_rays_.origin);
  points_.gather(samples_.to_light, shadow_rays_.direction);
  points_.gather(samples_.visible_until, shadow_rays_.t_max);
  tracer.occluded_rays(shadow_rays_, points_.count(), blocked_);
  for (std::size_t k = 0; k < points_.count(); ++k) {
    if (blocked_[k] == 0) add_seen(points_[k], radiance);
  }
}

void PathWave::trace_whole_lights(Tracer& tracer, RgbWave& radiance) {
  const Scene& scene = world_.scene;
  whole_.gather(vertices_.query.x, shadow_rays_.origin);
  whole_.gather(samples_.wi, shadow_rays_.direction);
  shadow_rays_.t_max = rays_.t_max;
  tracer.closest_hits(shadow_rays_, whole_.count(), shadow_hits_);
  for (std::size_t k = 0; k < whole_.count(); ++k) {
    if (!shadow_hits_.is_hit(k)) continue;
    Hit hit = shadow_hits_[k];
    if (technique_.model.overlays) hit = top_of(scene, shadow_rays_[k], hit);
    const std::size_t i = whole_[k];
    if (is_of(world_, samples_.whole[i], hit, shadow_rays_.origin[k])) add_seen(i, radiance);
  }
}

/// Whether a light sample that is reflected at this vertex can be seen, but for what stands in between.
bool PathWave::is_uncovered(std::size_t lane) const {
  if (!technique_.model.overlays || samples_.whole[lane] != nullptr) return true;
  const Ray to_light{vertices_.query.x[lane], samples_.to_light[lane], 0, samples_.visible_until[lane]};
  return !is_covered(world_.scene, to_light, samples_.emitter[lane]);
}

/// Leaves out the lanes whose directions lie below the geometric horizon.
void PathWave::keep_above(const VecWave& w, Wave<std::uint32_t>& lanes) {
  vertex_stages_.above(vertices_, w, count_, above_);
  for (std::size_t i = 0; i < count_; ++i) lanes[i] &= above_[i];
}

/// Draws directions by the BRDF and plays roulette.
void PathWave::scatter() {
  if (technique_.model.specular) {
    random_.draw_choice_pairs(count_, pairs_);
  } else {
    random_.draw_pairs(count_, pairs_);
  }
  phong_.sample(vertices_.materials, vertices_.wo, pairs_, count_, scattered_);
  vertex_stages_.to_world(vertices_, scattered_.wi, count_, world_wi_);
  weight_stages_.scatter(technique_.options.roulette, depth_, scattered_, count_, throughput_, continued_);
  if (technique_.model.smooth_normals) keep_above(world_wi_, continued_.alive);
  bool plays = false;
  for (std::size_t i = 0; i < count_; ++i) {
    const bool uncertain = continued_.alive[i] != 0 && continued_.survival[i] != 1;
    wanted_[i] = uncertain ? 1 : 0;
    plays |= uncertain;
  }
  if (plays) {
    random_.draw(count_, wanted_, u_);
    weight_stages_.survive(u_, count_, throughput_, continued_);
  }
}

/// Traces the rays of the paths that are left.
void PathWave::go_on(Tracer& tracer) {
  alive_.clear();
  for (std::size_t i = 0; i < count_; ++i) alive_.add_if(continued_.alive[i] != 0, i);
  const LaneList& lanes = alive_;
  const std::size_t count = lanes.count();
  lanes.keep(id_), lanes.keep(throughput_), random_.keep(lanes);
  lanes.keep(vertices_.query.x), lanes.keep(vertices_.query.n);
  if (technique_.model.specular) {
    lanes.keep(vertices_.query.mirror), lanes.keep(vertices_.query.diffuse);
    lanes.keep(vertices_.query.peak), lanes.keep(vertices_.query.width);
  }
  lanes.gather(scattered_.pdf, pdf_brdf_);
  lanes.gather(world_wi_, rays_.direction);
  rays_.origin = vertices_.query.x;
  count_ = count;
  if (technique_.model.glass) go_on_from_glass();
  tracer.closest_hits(rays_, count_, hits_);
}

void PathWave::go_on_from_glass() {
  for (const GlassPath& path : from_glass_) {
    id_[count_] = path.id, throughput_.set(count_, path.throughput), random_.set(count_, path.random);
    rays_.set(count_, path.ray);
    pdf_brdf_[count_] = std::numeric_limits<float>::infinity();
    ++count_;
  }
}

}  // namespace lemma
