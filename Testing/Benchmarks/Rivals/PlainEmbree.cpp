// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PlainEmbree.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace
{

using Vector = PlainScene::Vector;

float dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Uniform over the sphere.
Vector drawDirection(std::mt19937& random)
{
  std::normal_distribution<float> normal;
  const float x = normal(random), y = normal(random);
  return { x, y, normal(random) };
}

/// From the middle of the triangle, a little off its back.
RTCRayHit startRay(const PlainPatch& patch, float offset, const Vector& direction)
{
  RTCRayHit ray{};
  float* const origin = &ray.ray.org_x;
  for (std::size_t i = 0; i < 3; ++i)
  {
    origin[i] = patch.origin[i] + (2 * patch.u[i] + patch.v[i]) / 3 - offset * patch.normal[i];
  }
  ray.ray.dir_x = direction[0];
  ray.ray.dir_y = direction[1];
  ray.ray.dir_z = direction[2];
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}

PlainEmbree::PlainEmbree(const PlainScene& scene)
  : device_(rtcNewDevice("threads=1"))
  , scene_(rtcNewScene(device_))
{
  const std::vector<PlainScene::Triangle>& triangles = scene.triangles;
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
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
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

PlainEmbree::~PlainEmbree()
{
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

bool PlainEmbree::hasPacketsOf16() const
{
  return rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
}

std::vector<char> findOpenCells(const PlainScene& scene, const PlainEmbree& embree)
{
  constexpr int kRays = 64; // from each triangle
  std::vector<PlainPatch> patches;
  for (const PlainScene::Triangle& triangle : scene.triangles)
  {
    patches.push_back(makePatch(triangle, 0));
  }
  std::mt19937 random(1);
  std::vector<char> isOpen(scene.numberOfCells, 0);
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    char& found = isOpen[scene.surfaces[i].cell];
    for (int k = 0; k < kRays && !found; ++k)
    {
      Vector direction = drawDirection(random);
      if (dot(direction, patches[i].normal) > 0)
      {
        direction = { -direction[0], -direction[1], -direction[2] };
      }
      RTCRayHit ray = startRay(patches[i], scene.offset(), direction);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(embree.scene(), &context, &ray);
      found = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID &&
        dot(patches[ray.hit.primID].normal, direction) < 0;
    }
  }
  return isOpen;
}
