// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/EmbreeScene.h"

using namespace irradiance;

EmbreeScene::EmbreeScene(const SceneObjects& objects)
  : device_(rtcNewDevice("threads=1"))
  , top_(makeScene(objects.staticObject.body->mesh()))
  , near_(static_cast<float>(1e-5 * objects.staticObject.body->mesh().bounds().extent().maxCoeff()))
{
  for (std::uint32_t i = 1; i < objects.size(); ++i)
  {
    const RTCScene part = makeScene(objects[i].body->mesh());
    rtcCommitScene(part);
    const RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, part);
    rtcReleaseScene(part); // the instance keeps it
    Eigen::Matrix<float, 3, 4> pose;
    pose << objects[i].worldFromObject.linear.cast<float>(),
      objects[i].worldFromObject.translation.cast<float>();
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, pose.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(top_, instance, i);
    rtcReleaseGeometry(instance);
  }
  rtcCommitScene(top_);
}

EmbreeScene::~EmbreeScene()
{
  rtcReleaseScene(top_);
  rtcReleaseDevice(device_);
}

RTCScene EmbreeScene::makeScene(const TriangleMesh& mesh) const
{
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * mesh.size()));
  auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.size()));
  std::uint32_t corner = 0;
  for (const Triangle& triangle : mesh.triangles())
  {
    for (const Vector3& point : { triangle.a, triangle.b, triangle.c })
    {
      Eigen::Map<Eigen::Vector3f>(points + 3 * corner) = point.cast<float>();
      corners[corner] = corner;
      ++corner;
    }
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  const RTCScene scene = rtcNewScene(device_);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometryByID(scene, geometry, 0);
  rtcReleaseGeometry(geometry);
  return scene;
}
