#pragma once

// What differs between Embree 4 and Embree 3: the folder of the header and the arguments of the queries.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace lemma::embree_api {

/// Of the rays of a packet: whether they start alike and go alike. It decides how they are traced.
enum class Rays { coherent, incoherent };

#if RTC_VERSION_MAJOR >= 4

inline void intersect(RTCScene scene, RTCRayHit& ray) {
  rtcIntersect1(scene, &ray, nullptr);
}

inline void occluded(RTCScene scene, RTCRay& ray) {
  rtcOccluded1(scene, &ray, nullptr);
}

/// @param valid  16 words: -1 for a ray, 0 for none
inline void intersect(const int* valid, RTCScene scene, Rays how, RTCRayHit16& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = how == Rays::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

/// Of incoherent rays.
inline void occluded(const int* valid, RTCScene scene, RTCRay16& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

inline void intersect(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}

inline void occluded(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}

/// @param valid  16 words: -1 for a ray, 0 for none
inline void intersect(const int* valid, RTCScene scene, Rays how, RTCRayHit16& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      how == Rays::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
}

/// Of incoherent rays.
inline void occluded(const int* valid, RTCScene scene, RTCRay16& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
}

#endif

}  // namespace lemma::embree_api
