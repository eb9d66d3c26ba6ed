// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PlainEmbree.h"

#include <cstring>

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
