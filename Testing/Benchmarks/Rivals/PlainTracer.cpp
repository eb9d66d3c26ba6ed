// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PlainTracer.h"

#include "Rivals/XorShift.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>

namespace
{

/// Walks side by side. From 512 to 16384 the times differ by a few percent.
constexpr std::size_t kBatch = 4096;

void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHit8& packet)
{
  rtcIntersect8(valid, scene, &context, &packet);
}

void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHit16& packet)
{
  rtcIntersect16(valid, scene, &context, &packet);
}

std::vector<double> fluxesOf(const PlainScene& scene)
{
  std::vector<double> fluxes;
  for (const PlainScene::Light& light : scene.lights)
  {
    fluxes.push_back(light.flux);
  }
  if (fluxes.empty())
  {
    throw std::invalid_argument("the plain tracer needs a light");
  }
  return fluxes;
}

RTCScene makeEmbreeScene(RTCDevice device, const std::vector<PlainScene::Triangle>& triangles)
{
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* points = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
    sizeof(PlainScene::Vector), 3 * triangles.size());
  std::memcpy(points, triangles.data(), triangles.size() * sizeof(PlainScene::Triangle));
  auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry,
    RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
  for (std::uint32_t i = 0; i < 3 * triangles.size(); ++i)
  {
    corners[i] = i;
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

}

/// Walks side by side, from their lights to where they end. `Packet`: RTCRayHit8 or RTCRayHit16.
template <class Packet>
class PlainWavefront
{
public:
  PlainWavefront(const PlainTracer& tracer, std::uint64_t seed)
    : tracer_(tracer)
    , random_(seed)
  {
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (int k = 0; k < kWidth; ++k)
    {
      packet_.ray.tnear[k] = 0;
      packet_.ray.time[k] = 0;
      packet_.ray.mask[k] = ~0u;
      packet_.ray.flags[k] = 0;
      packet_.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  /// `count`: at most kBatch.
  void run(std::size_t count, PlainTracer::Tally& tally)
  {
    start(count);
    while (count > 0)
    {
      tally.segments += static_cast<std::int64_t>(count);
      count = bounce(count, tally.hits.data());
    }
  }

private:
  static constexpr int kWidth = sizeof(Packet::ray.org_x) / sizeof(float);

  struct alignas(64) Lanes
  {
    float x[kWidth], y[kWidth], z[kWidth];
  };
  /// Of all walks; a packet's worth more, as whole packets are written.
  struct alignas(64) Column
  {
    float x[kBatch + kWidth], y[kBatch + kWidth], z[kBatch + kWidth];
  };

  void start(std::size_t count)
  {
    for (std::size_t first = 0; first < count; first += kWidth)
    {
      Lanes origins, normals;
      drawOrigins(origins, normals);
      const Lanes directions = drawDirections(normals);
      store(origins, origins_, first);
      store(directions, directions_, first);
    }
  }

  void drawOrigins(Lanes& origins, Lanes& normals)
  {
    alignas(64) float place[kWidth], choice[kWidth], u[kWidth], v[kWidth];
    for (float* numbers : { place, choice, u, v })
    {
      random_.next(numbers);
    }
    for (int k = 0; k < kWidth; ++k)
    {
      u[k] = std::sqrt(u[k]); // so that the points are even over a triangle
      v[k] *= u[k];
    }
    for (int k = 0; k < kWidth; ++k)
    {
      const PlainTracer::Source& source =
        tracer_.sources_[tracer_.choice_.draw(place[k], choice[k])];
      const auto coordinate = [&](int i) {
        return source.origin[i] + u[k] * source.u[i] + v[k] * source.v[i];
      };
      origins.x[k] = coordinate(0);
      origins.y[k] = coordinate(1);
      origins.z[k] = coordinate(2);
      normals.x[k] = source.normal[0];
      normals.y[k] = source.normal[1];
      normals.z[k] = source.normal[2];
    }
  }

  /// Cosine-distributed around normals of unit length, but not of unit length themselves, which Embree
  /// does not need: a normal plus a point of the unit sphere.
  Lanes drawDirections(const Lanes& normals)
  {
    alignas(64) float height[kWidth], turn[kWidth];
    random_.next(height);
    random_.next(turn);
    Lanes directions;
    for (int k = 0; k < kWidth; ++k)
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

  /// One segment of each walk; the walks that survive move up. Returns how many they are.
  std::size_t bounce(std::size_t count, double* hits)
  {
    std::size_t kept = 0;
    for (std::size_t first = 0; first < count; first += kWidth)
    {
      cast(first, count - first);
      alignas(64) float chance[kWidth];
      random_.next(chance);
      bool survives[kWidth];
      for (int k = 0; k < kWidth; ++k)
      {
        const PlainScene::Surface surface = tracer_.surfaces_[packet_.hit.primID[k]];
        hits[surface.cell] += 1;
        survives[k] = chance[k] < surface.reflectance;
      }
      Lanes origins, normals;
      findPoints(origins, normals);
      const Lanes directions = drawDirections(normals);
      // Without a branch: what does not survive is overwritten by the next walk.
      for (int k = 0; k < kWidth; ++k)
      {
        origins_.x[kept] = origins.x[k];
        origins_.y[kept] = origins.y[k];
        origins_.z[kept] = origins.z[k];
        directions_.x[kept] = directions.x[k];
        directions_.y[kept] = directions.y[k];
        directions_.z[kept] = directions.z[k];
        kept += survives[k];
      }
    }
    return kept;
  }

  /// `left`: walks from `first` on. Lanes past them, and rays that escape, hit the extra surface.
  void cast(std::size_t first, std::size_t left)
  {
    load(origins_, first, packet_.ray.org_x, packet_.ray.org_y, packet_.ray.org_z);
    load(directions_, first, packet_.ray.dir_x, packet_.ray.dir_y, packet_.ray.dir_z);
    const auto escaped = static_cast<unsigned>(tracer_.surfaces_.size() - 1);
    for (int k = 0; k < kWidth; ++k)
    {
      const bool isWalk = static_cast<std::size_t>(k) < left;
      valid_[k] = isWalk ? -1 : 0;
      // Where Embree has no packets of this width in instructions, it heeds the empty interval alone.
      packet_.ray.tfar[k] = isWalk ? std::numeric_limits<float>::max() : -1.f;
      packet_.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      packet_.hit.primID[k] = escaped;
    }
    intersect(valid_, tracer_.embree_, context_, packet_);
  }

  /// Where the rays have hit, a little off the surface, and its normals on that side.
  void findPoints(Lanes& origins, Lanes& normals) const
  {
    const auto& ray = packet_.ray;
    const auto& hit = packet_.hit;
    for (int k = 0; k < kWidth; ++k)
    {
      const float length = std::sqrt(
        hit.Ng_x[k] * hit.Ng_x[k] + hit.Ng_y[k] * hit.Ng_y[k] + hit.Ng_z[k] * hit.Ng_z[k]);
      const float along =
        hit.Ng_x[k] * ray.dir_x[k] + hit.Ng_y[k] * ray.dir_y[k] + hit.Ng_z[k] * ray.dir_z[k];
      const float scale = std::copysign(1 / length, -along);
      normals.x[k] = scale * hit.Ng_x[k];
      normals.y[k] = scale * hit.Ng_y[k];
      normals.z[k] = scale * hit.Ng_z[k];
      const float distance = ray.tfar[k], offset = tracer_.offset_;
      origins.x[k] = ray.org_x[k] + distance * ray.dir_x[k] + offset * normals.x[k];
      origins.y[k] = ray.org_y[k] + distance * ray.dir_y[k] + offset * normals.y[k];
      origins.z[k] = ray.org_z[k] + distance * ray.dir_z[k] + offset * normals.z[k];
    }
  }

  static void store(const Lanes& lanes, Column& column, std::size_t first)
  {
    std::memcpy(column.x + first, lanes.x, sizeof(lanes.x));
    std::memcpy(column.y + first, lanes.y, sizeof(lanes.y));
    std::memcpy(column.z + first, lanes.z, sizeof(lanes.z));
  }
  static void load(const Column& column, std::size_t first, float* x, float* y, float* z)
  {
    constexpr std::size_t kBytes = kWidth * sizeof(float);
    std::memcpy(x, column.x + first, kBytes);
    std::memcpy(y, column.y + first, kBytes);
    std::memcpy(z, column.z + first, kBytes);
  }

  const PlainTracer& tracer_;
  RTCIntersectContext context_;
  Packet packet_{};
  alignas(64) int valid_[kWidth];
  XorShift<kWidth> random_;
  Column origins_{}, directions_{};
};

namespace
{

template <class Packet>
void shootWide(
  const PlainTracer& tracer, std::uint32_t walks, std::uint64_t seed, PlainTracer::Tally& tally)
{
  const auto wavefront = std::make_unique<PlainWavefront<Packet>>(tracer, seed);
  for (std::size_t first = 0; first < walks; first += kBatch)
  {
    wavefront->run(std::min(kBatch, walks - first), tally);
  }
}

}

PlainTracer::PlainTracer(const PlainScene& scene, Packets packets)
  : surfaces_(scene.surfaces)
  , numberOfCells_(scene.numberOfCells)
  , choice_(fluxesOf(scene))
  , offset_(1e-5f * scene.extent)
  , device_(rtcNewDevice("threads=1"))
  , embree_(makeEmbreeScene(device_, scene.triangles))
{
  surfaces_.push_back({ 0, static_cast<std::uint32_t>(numberOfCells_) });
  std::transform(scene.lights.begin(), scene.lights.end(), std::back_inserter(sources_),
    [this](const PlainScene::Light& light) { return makeSource(light); });
  const bool isWide = packets == Packets::Best &&
    rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  width_ = isWide ? 16 : 8;
}

PlainTracer::~PlainTracer()
{
  rtcReleaseScene(embree_);
  rtcReleaseDevice(device_);
}

PlainTracer::Source PlainTracer::makeSource(const PlainScene::Light& light) const
{
  const auto& [a, b, c] = light.triangle;
  Source source{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    source.u[i] = b[i] - a[i];
    source.v[i] = c[i] - b[i];
  }
  double normal[3], square = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    normal[i] = double(source.u[j]) * source.v[k] - double(source.u[k]) * source.v[j];
    square += normal[i] * normal[i];
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    source.normal[i] = static_cast<float>(normal[i] / std::sqrt(square));
    source.origin[i] = a[i] + offset_ * source.normal[i];
  }
  return source;
}

PlainTracer::Tally PlainTracer::shoot(std::uint32_t walks, std::uint64_t seed) const
{
  Tally tally{ std::vector<double>(numberOfCells_ + 1, 0.0), 0 };
  (width_ == 16 ? shootWide<RTCRayHit16> : shootWide<RTCRayHit8>)(*this, walks, seed, tally);
  tally.hits.pop_back(); // what escaped
  return tally;
}
