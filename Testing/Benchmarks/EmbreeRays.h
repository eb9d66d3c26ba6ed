#ifndef EmbreeRays_h
#define EmbreeRays_h

#include "EmbreeScene.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

/**
 * Rays in the form that Embree takes, which is where they are made and where their hits are read:
 * nothing is copied. `Packet` is RTCRayHit for one ray a call, RTCRayHit8 or RTCRayHit16.
 */
template <class Packet>
class EmbreeRays
{
public:
  EmbreeRays(const EmbreeScene& scene, std::size_t size)
    : scene_(scene)
    , packets_((size + kWidth - 1) / kWidth)
  {
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  void set(std::size_t i, const irradiance::Ray& ray)
  {
    Packet& packet = packets_[i / kWidth];
    const std::size_t k = i % kWidth;
    lane(packet.ray.org_x, k) = static_cast<float>(ray.origin[0]);
    lane(packet.ray.org_y, k) = static_cast<float>(ray.origin[1]);
    lane(packet.ray.org_z, k) = static_cast<float>(ray.origin[2]);
    lane(packet.ray.dir_x, k) = static_cast<float>(ray.direction[0]);
    lane(packet.ray.dir_y, k) = static_cast<float>(ray.direction[1]);
    lane(packet.ray.dir_z, k) = static_cast<float>(ray.direction[2]);
    lane(packet.ray.tnear, k) = scene_.nearest();
    lane(packet.ray.tfar, k) = std::numeric_limits<float>::infinity();
    lane(packet.ray.time, k) = 0;
    lane(packet.ray.mask, k) = ~0u;
    lane(packet.ray.flags, k) = 0;
    lane(packet.hit.geomID, k) = RTC_INVALID_GEOMETRY_ID;
    lane(packet.hit.instID[0], k) = RTC_INVALID_GEOMETRY_ID;
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
  irradiance::TriangleId id(std::size_t i)
  {
    Packet& packet = packets_[i / kWidth];
    const std::size_t k = i % kWidth;
    if (lane(packet.hit.geomID, k) == RTC_INVALID_GEOMETRY_ID)
    {
      return {};
    }
    const unsigned instance = lane(packet.hit.instID[0], k);
    return { instance == RTC_INVALID_GEOMETRY_ID ? 0 : instance, lane(packet.hit.primID, k) };
  }
  irradiance::Vector3 weights(std::size_t i)
  {
    Packet& packet = packets_[i / kWidth];
    const double u = lane(packet.hit.u, i % kWidth), v = lane(packet.hit.v, i % kWidth);
    return { std::max(0.0, 1 - u - v), u, v };
  }
  irradiance::Vector3 direction(std::size_t i)
  {
    Packet& packet = packets_[i / kWidth];
    const std::size_t k = i % kWidth;
    return { lane(packet.ray.dir_x, k), lane(packet.ray.dir_y, k), lane(packet.ray.dir_z, k) };
  }

private:
  static constexpr std::size_t kWidth = sizeof(Packet::ray.org_x) / sizeof(float);

  // A member of a packet is an array, that of a single ray is not.
  template <class T, std::size_t N>
  static T& lane(T (&lanes)[N], std::size_t k)
  {
    return lanes[k];
  }
  template <class T>
  static T& lane(T& only, std::size_t /*k*/)
  {
    return only;
  }

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
  RTCIntersectContext context_;
  std::vector<Packet> packets_;
  alignas(64) int valid_[kWidth];
};

#endif
