// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <embree3/rtcore.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

/// What the plain rivals share, with a lane for each ray of a packet. Only for files that are
/// compiled for the machine at hand. `Packet`: RTCRayHit8 or RTCRayHit16.

template <class Packet>
constexpr int kWidthOf = sizeof(Packet::ray.org_x) / sizeof(float);

template <int width>
struct alignas(64) Lanes
{
  float x[width], y[width], z[width];
};

/// Of all paths that are traced side by side; a packet's worth more, as whole packets are written.
template <int width>
struct alignas(64) LaneColumn
{
  /// From 512 to 16384 the times differ by a few percent.
  static constexpr std::size_t kBatch = 4096;

  void store(const Lanes<width>& lanes, std::size_t first)
  {
    std::memcpy(x + first, lanes.x, sizeof(lanes.x));
    std::memcpy(y + first, lanes.y, sizeof(lanes.y));
    std::memcpy(z + first, lanes.z, sizeof(lanes.z));
  }
  void set(std::size_t i, const Lanes<width>& lanes, int k)
  {
    x[i] = lanes.x[k];
    y[i] = lanes.y[k];
    z[i] = lanes.z[k];
  }
  void load(std::size_t first, float* toX, float* toY, float* toZ) const
  {
    constexpr std::size_t kBytes = width * sizeof(float);
    std::memcpy(toX, x + first, kBytes);
    std::memcpy(toY, y + first, kBytes);
    std::memcpy(toZ, z + first, kBytes);
  }

  float x[kBatch + width], y[kBatch + width], z[kBatch + width];
};

inline void intersect(
  const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHit8& packet)
{
  rtcIntersect8(valid, scene, &context, &packet);
}

inline void intersect(
  const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHit16& packet)
{
  rtcIntersect16(valid, scene, &context, &packet);
}

inline RTCIntersectContext incoherentRays()
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

/// What no ray changes. `Rays`: RTCRay8 or RTCRay16.
template <class Rays>
void initialize(Rays& rays)
{
  for (std::size_t k = 0; k < sizeof(rays.org_x) / sizeof(float); ++k)
  {
    rays.tnear[k] = 0;
    rays.time[k] = 0;
    rays.mask[k] = ~0u;
    rays.flags[k] = 0;
  }
}

/// Casts rays whose origins and directions are set. `left`: how many lanes have a ray, if less than
/// all. The others, and rays that escape, hit the primitive `nothing`.
template <class Packet>
void cast(
  RTCScene scene, RTCIntersectContext& context, std::size_t left, unsigned nothing, Packet& packet)
{
  alignas(64) int valid[kWidthOf<Packet>];
  for (int k = 0; k < kWidthOf<Packet>; ++k)
  {
    const bool isRay = static_cast<std::size_t>(k) < left;
    valid[k] = isRay ? -1 : 0;
    // Where Embree has no packets of this width in instructions, it heeds the empty interval alone.
    packet.ray.tfar[k] = isRay ? std::numeric_limits<float>::max() : -1.f;
    packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.primID[k] = nothing;
  }
  intersect(valid, scene, context, packet);
}

/// Cosine-distributed around normals of unit length, but not of unit length themselves, which
/// Embree does not need: a normal plus a point of the unit sphere. Their length is 2 x the cosine.
/// `height`, `turn`: uniform in [0, 1).
template <int width>
Lanes<width> cosineDirections(const Lanes<width>& normals, const float* height, const float* turn)
{
  Lanes<width> directions;
  for (int k = 0; k < width; ++k)
  {
    // Half a turn is drawn, in which polynomials are short, and every other one is mirrored.
    const float t = std::abs(2 * turn[k] - 1) - 0.5f, tt = t * t;
    const float side = std::copysign(1.f, turn[k] - 0.5f);
    // sin and cos of pi t for |t| <= 1/2, by Taylor; they are right to 5e-7.
    const float sine = t *
      (3.14159265f +
        tt *
          (-5.16771278f +
            tt * (2.55016404f + tt * (-0.59926453f + tt * (0.08214589f - tt * 0.00737043f)))));
    const float cosine = 1 +
      tt *
        (-4.93480220f +
          tt * (4.05871213f + tt * (-1.33526277f + tt * (0.23533063f - tt * 0.02580689f))));
    const float radius = 2 * std::sqrt(height[k] * (1 - height[k]));
    directions.x[k] = normals.x[k] + radius * side * cosine;
    directions.y[k] = normals.y[k] + radius * sine;
    directions.z[k] = normals.z[k] + (1 - 2 * height[k]);
  }
  return directions;
}

/// Where rays have hit, that far off the surface, and its normals on that side.
template <class Packet>
void findPoints(const Packet& packet, float offset, Lanes<kWidthOf<Packet>>& points,
  Lanes<kWidthOf<Packet>>& normals)
{
  const auto& ray = packet.ray;
  const auto& hit = packet.hit;
  for (int k = 0; k < kWidthOf<Packet>; ++k)
  {
    const float length =
      std::sqrt(hit.Ng_x[k] * hit.Ng_x[k] + hit.Ng_y[k] * hit.Ng_y[k] + hit.Ng_z[k] * hit.Ng_z[k]);
    const float along =
      hit.Ng_x[k] * ray.dir_x[k] + hit.Ng_y[k] * ray.dir_y[k] + hit.Ng_z[k] * ray.dir_z[k];
    const float scale = std::copysign(1 / length, -along);
    normals.x[k] = scale * hit.Ng_x[k];
    normals.y[k] = scale * hit.Ng_y[k];
    normals.z[k] = scale * hit.Ng_z[k];
    const float distance = ray.tfar[k];
    points.x[k] = ray.org_x[k] + distance * ray.dir_x[k] + offset * normals.x[k];
    points.y[k] = ray.org_y[k] + distance * ray.dir_y[k] + offset * normals.y[k];
    points.z[k] = ray.org_z[k] + distance * ray.dir_z[k] + offset * normals.z[k];
  }
}
