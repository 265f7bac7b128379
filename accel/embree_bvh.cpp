#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <stdexcept>

#include "accel/accelerator.h"
#include "accel/embree_api.h"
#include "accel/hit_wave.h"
#include "accel/watertight.h"
#include "src/core/error_bound.h"

namespace lemma {
namespace {

using embree_api::Rays;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

bool count_memory(void* bytes, ssize_t change, bool) {
  static_cast<std::atomic<std::int64_t>*>(bytes)->fetch_add(change);
  return true;
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree reports error {}", static_cast<int>(error)));
}

/// Embree takes intervals closed, Lemma's are open; it has no name for a ray that starts at its own surface,
/// so t_min 0 becomes the smallest normal number.
float nearest_of(const Ray& ray) {
  return std::max(next_float_towards(ray.t_min, 1), std::numeric_limits<float>::min());
}
float farthest_of(const Ray& ray) {
  return next_float_towards(ray.t_max, -1);  // infinity stays
}

RTCRay to_embree(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = nearest_of(ray), r.tfar = farthest_of(ray);
  r.mask = 0xFFFFFFFFu;
  return r;
}

/// Embree's answer to rays that are not finite is undefined. Without branches, for loops over many rays.
bool is_finite(const Ray& ray) {
  return lemma::is_finite(ray.origin) & lemma::is_finite(ray.direction) & (ray.t_min < ray.t_max);
}

constexpr std::size_t kPacket = 16;
static_assert(kPacket == kWaveStep);

/// Up to 16 rays as Embree takes them, and which lanes hold one: -1, else 0.
struct Packet {
  /// The rays of a wave's lanes from `begin` to `end`, or 16 of them. Lanes without one hold a ray all the
  /// same: where Embree has no packets of 16 for the machine, its checks look at all lanes. A loop that
  /// compilers make vector code of.
  Packet(RTCRay16& packet, const RayWave& rays, std::size_t begin, std::size_t end) {
    const float* const org_x = &rays.origin.x.values[begin];
    const float* const org_y = &rays.origin.y.values[begin];
    const float* const org_z = &rays.origin.z.values[begin];
    const float* const dir_x = &rays.direction.x.values[begin];
    const float* const dir_y = &rays.direction.y.values[begin];
    const float* const dir_z = &rays.direction.z.values[begin];
    const float* const t_max = &rays.t_max.values[begin];
    const auto lanes = static_cast<int>(std::min(kPacket, end - begin));
    for (int i = 0; i < static_cast<int>(kPacket); ++i) {
      const Ray ray{{org_x[i], org_y[i], org_z[i]}, {dir_x[i], dir_y[i], dir_z[i]}, 0, t_max[i]};
      const bool is_ray = (i < lanes) & is_finite(ray);
      valid[i] = is_ray ? -1 : 0;
      packet.org_x[i] = is_ray ? ray.origin.x : 0, packet.org_y[i] = is_ray ? ray.origin.y : 0;
      packet.org_z[i] = is_ray ? ray.origin.z : 0;
      packet.dir_x[i] = is_ray ? ray.direction.x : 0, packet.dir_y[i] = is_ray ? ray.direction.y : 0;
      packet.dir_z[i] = is_ray ? ray.direction.z : 1;
      packet.tnear[i] = nearest_of(ray), packet.tfar[i] = is_ray ? farthest_of(ray) : 0;
      packet.time[i] = 0, packet.mask[i] = 0xFFFFFFFFu, packet.id[i] = 0, packet.flags[i] = 0;
    }
  }

  alignas(64) int valid[kPacket];
};

void expect_no_hit(RTCHit16& hit) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

class EmbreeBvh final : public Accelerator {
 public:
  explicit EmbreeBvh(std::span<const Triangle> triangles)
      : triangles_(triangles), device_(rtcNewDevice(nullptr)) {
    if (!device_) check(nullptr);
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_memory, &bytes_);
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    add_triangles();
    rtcCommitScene(scene_.get());
    check(device_.get());
  }

  std::optional<Hit> closest_hit(const Ray& ray) const override {
    if (!is_finite(ray)) return std::nullopt;
    RTCRayHit query{to_embree(ray), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree_api::intersect(scene_.get(), query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return hit_on(ShearedRay(ray), triangles_[query.hit.primID], query.hit.primID);
  }

  bool occluded(const Ray& ray) const override {
    if (!is_finite(ray)) return false;
    RTCRay query = to_embree(ray);
    embree_api::occluded(scene_.get(), query);
    return query.tfar < 0;
  }

  void closest_hits(const RayWave& rays, std::size_t count, Coherence coherence,
                    HitWave& hits) const override {
    const Rays alike = coherence == Coherence::steps ? Rays::coherent : Rays::incoherent;
    RTCRayHit16 query;
    for (std::size_t begin = 0; begin < count; begin += kPacket) {
      const Packet packet(query.ray, rays, begin, count);
      expect_no_hit(query.hit);
      embree_api::intersect(packet.valid, scene_.get(), alike, query);
      for (std::size_t i = 0; i < kPacket; ++i) {
        const bool is_hit = query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        hits.triangle[begin + i] = is_hit ? query.hit.primID[i] : HitWave::kNoTriangle;
      }
    }
    hits_on_(triangles_, rays, count, hits);
  }

  void occluded_rays(const RayWave& rays, std::size_t count, Wave<std::uint8_t>& blocked) const override {
    RTCRay16 query;
    for (std::size_t begin = 0; begin < count; begin += kPacket) {
      const Packet packet(query, rays, begin, count);
      embree_api::occluded(packet.valid, scene_.get(), query);
      for (std::size_t i = 0; i < kPacket; ++i)
        blocked[begin + i] = (packet.valid[i] != 0) & (query.tfar[i] < 0) ? 1 : 0;
    }
  }

  std::size_t memory_bytes() const override { return static_cast<std::size_t>(bytes_.load()); }

  std::string description() const override {
    return fmt::format("Embree {} BVH, ROBUST, {} triangles", RTC_VERSION_STRING, triangles_.size());
  }

 private:
  void add_triangles() {
    const std::size_t count = triangles_.size();
    if (count == 0) return;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
    if (!vertices || !indices) throw std::bad_alloc();
    for (const Triangle& t : triangles_) {
      for (const Vec3& v : {t.v0, t.v1, t.v2}) vertices = std::copy_n(&v[0], 3, vertices);
    }
    for (std::uint32_t i = 0; i < 3 * count; ++i) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  std::span<const Triangle> triangles_;
  decltype(HitsOnTriangles::function) hits_on_ = hits_on_triangles().function;
  std::atomic<std::int64_t> bytes_{0};  // outlives the device, which reports to it until it is gone
  Device device_;
  SceneHandle scene_;
};

}  // namespace

std::unique_ptr<const Accelerator> make_embree(std::span<const Triangle> triangles,
                                               const AcceleratorOptions&) {
  return std::make_unique<EmbreeBvh>(triangles);
}

}  // namespace lemma
