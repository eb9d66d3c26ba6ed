// SPDX-License-Identifier: BSD-3-Clause
#ifndef EmbreeRays_h
#define EmbreeRays_h

#include "Rivals/EmbreeScene.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

/**
 * Rays in the form that Embree takes, which is where they are made and where their hits are read:
 * nothing is copied. `Packet` is RTCRayHit for one ray a call, RTCRayHit8 or RTCRayHit16. Embree is
 * told that the rays are incoherent: with the other flag, packets of photon rays are two to four
 * times slower.
 */
template <class Packet>
class EmbreeRays
{
public:
  static constexpr std::size_t kWidth = sizeof(Packet::ray.org_x) / sizeof(float);

  /// `nearest`: hits closer than this do not count.
  EmbreeRays(const EmbreeScene& scene, std::size_t size, float nearest)
    : scene_(scene)
    , nearest_(nearest)
    , packets_((size + kWidth - 1) / kWidth)
  {
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  void set(std::size_t i, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction)
  {
    const unsigned k = i % kWidth;
    RTCRayN* ray = rayAt(i);
    RTCRayN_org_x(ray, kWidth, k) = origin[0];
    RTCRayN_org_y(ray, kWidth, k) = origin[1];
    RTCRayN_org_z(ray, kWidth, k) = origin[2];
    RTCRayN_dir_x(ray, kWidth, k) = direction[0];
    RTCRayN_dir_y(ray, kWidth, k) = direction[1];
    RTCRayN_dir_z(ray, kWidth, k) = direction[2];
    RTCRayN_tnear(ray, kWidth, k) = nearest_;
    RTCRayN_tfar(ray, kWidth, k) = std::numeric_limits<float>::infinity();
    RTCRayN_time(ray, kWidth, k) = 0;
    RTCRayN_mask(ray, kWidth, k) = ~0u;
    RTCRayN_flags(ray, kWidth, k) = 0;
    RTCHitN_geomID(hitAt(i), kWidth, k) = RTC_INVALID_GEOMETRY_ID;
    RTCHitN_instID(hitAt(i), kWidth, k, 0) = RTC_INVALID_GEOMETRY_ID;
  }

  /// The first `count` of them.
  void cast(std::size_t count)
  {
    for (std::size_t first = 0; first < count; first += kWidth)
    {
      intersect(packets_[first / kWidth], std::min(kWidth, count - first));
    }
  }

  /// What a ray that was cast has hit; none: it escapes.
  irradiance::Hit hit(std::size_t i)
  {
    const unsigned k = i % kWidth;
    RTCHitN* hit = hitAt(i);
    if (RTCHitN_geomID(hit, kWidth, k) == RTC_INVALID_GEOMETRY_ID)
    {
      return {};
    }
    const unsigned instance = RTCHitN_instID(hit, kWidth, k, 0);
    return { RTCRayN_tfar(rayAt(i), kWidth, k),
      { instance == RTC_INVALID_GEOMETRY_ID ? 0 : instance, RTCHitN_primID(hit, kWidth, k) },
      { RTCHitN_u(hit, kWidth, k), RTCHitN_v(hit, kWidth, k) } };
  }
  irradiance::Vector3 direction(std::size_t i)
  {
    const unsigned k = i % kWidth;
    RTCRayN* ray = rayAt(i);
    return { RTCRayN_dir_x(ray, kWidth, k), RTCRayN_dir_y(ray, kWidth, k),
      RTCRayN_dir_z(ray, kWidth, k) };
  }

private:
  // Embree's accessors take a packet of any width, and a single ray as a packet of one.
  RTCRayN* rayAt(std::size_t i) { return reinterpret_cast<RTCRayN*>(&packets_[i / kWidth].ray); }
  RTCHitN* hitAt(std::size_t i) { return reinterpret_cast<RTCHitN*>(&packets_[i / kWidth].hit); }

  void intersect(RTCRayHit& ray, std::size_t /*count*/)
  {
    rtcIntersect1(scene_.top(), &context_, &ray);
  }
  void intersect(RTCRayHit8& packet, std::size_t count)
  {
    rtcIntersect8(firstLanes(count), scene_.top(), &context_, &packet);
  }
  void intersect(RTCRayHit16& packet, std::size_t count)
  {
    rtcIntersect16(firstLanes(count), scene_.top(), &context_, &packet);
  }
  /// -1 for the first lanes, 0 for the others.
  const int* firstLanes(std::size_t count)
  {
    for (std::size_t k = 0; k < kWidth; ++k)
    {
      valid_[k] = k < count ? -1 : 0;
    }
    return valid_;
  }

  const EmbreeScene& scene_;
  float nearest_;
  RTCIntersectContext context_;
  std::vector<Packet> packets_;
  alignas(64) int valid_[kWidth];
};

#endif
