// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/EmbreeScene.h"

#include <algorithm>
#include <limits>

using namespace irradiance;

namespace
{

struct FloatRay
{
  Eigen::Vector3f origin, direction;
};

template <class Packet>
constexpr std::size_t kWidthOf = sizeof(Packet::ray.org_x) / sizeof(float);

/// Sets a lane. Embree's accessors take a packet of any width, and a single ray as a packet of one.
template <class Packet>
void set(Packet& packet, unsigned k, const FloatRay& own)
{
  constexpr unsigned kWidth = kWidthOf<Packet>;
  auto* const ray = reinterpret_cast<RTCRayN*>(&packet.ray);
  auto* const hit = reinterpret_cast<RTCHitN*>(&packet.hit);
  RTCRayN_org_x(ray, kWidth, k) = own.origin[0];
  RTCRayN_org_y(ray, kWidth, k) = own.origin[1];
  RTCRayN_org_z(ray, kWidth, k) = own.origin[2];
  RTCRayN_dir_x(ray, kWidth, k) = own.direction[0];
  RTCRayN_dir_y(ray, kWidth, k) = own.direction[1];
  RTCRayN_dir_z(ray, kWidth, k) = own.direction[2];
  RTCRayN_tnear(ray, kWidth, k) = 0;
  RTCRayN_tfar(ray, kWidth, k) = std::numeric_limits<float>::infinity();
  RTCRayN_time(ray, kWidth, k) = 0;
  RTCRayN_mask(ray, kWidth, k) = ~0u;
  RTCRayN_flags(ray, kWidth, k) = 0;
  RTCHitN_geomID(hit, kWidth, k) = RTC_INVALID_GEOMETRY_ID;
  RTCHitN_instID(hit, kWidth, k, 0) = RTC_INVALID_GEOMETRY_ID;
}

/// What a lane that was cast has hit; none: it escapes.
template <class Packet>
Hit hitOf(Packet& packet, unsigned k)
{
  constexpr unsigned kWidth = kWidthOf<Packet>;
  auto* const hit = reinterpret_cast<RTCHitN*>(&packet.hit);
  if (RTCHitN_geomID(hit, kWidth, k) == RTC_INVALID_GEOMETRY_ID)
  {
    return {};
  }
  const unsigned instance = RTCHitN_instID(hit, kWidth, k, 0);
  return { RTCRayN_tfar(reinterpret_cast<RTCRayN*>(&packet.ray), kWidth, k),
    { instance == RTC_INVALID_GEOMETRY_ID ? 0 : instance, RTCHitN_primID(hit, kWidth, k) },
    { RTCHitN_u(hit, kWidth, k), RTCHitN_v(hit, kWidth, k) } };
}

void intersect(const int*, RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray)
{
  rtcIntersect1(scene, context, ray);
}
void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit8* packet)
{
  rtcIntersect8(valid, scene, context, packet);
}
void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* packet)
{
  rtcIntersect16(valid, scene, context, packet);
}

}

template <class Packet>
Caster makeEmbreeCaster(std::shared_ptr<const EmbreeScene> scene)
{
  return [scene](const std::vector<Ray>& rays) -> Cast {
    std::vector<FloatRay> own;
    for (const Ray& ray : rays)
    {
      own.push_back({ ray.origin.cast<float>(), ray.direction.cast<float>() });
    }
    return [scene, own](std::vector<Hit>& hits) {
      constexpr std::size_t kWidth = kWidthOf<Packet>;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
      Packet packet{};
      alignas(64) int valid[kWidth];
      for (std::size_t first = 0; first < own.size(); first += kWidth)
      {
        const std::size_t count = std::min(kWidth, own.size() - first);
        for (std::size_t k = 0; k < count; ++k)
        {
          set(packet, static_cast<unsigned>(k), own[first + k]);
        }
        std::fill(std::fill_n(valid, count, -1), valid + kWidth, 0);
        intersect(valid, scene->top(), &context, &packet);
        for (std::size_t k = 0; k < count; ++k)
        {
          hits[first + k] = hitOf(packet, static_cast<unsigned>(k));
        }
      }
    };
  };
}

template Caster makeEmbreeCaster<RTCRayHit>(std::shared_ptr<const EmbreeScene>);
template Caster makeEmbreeCaster<RTCRayHit8>(std::shared_ptr<const EmbreeScene>);
template Caster makeEmbreeCaster<RTCRayHit16>(std::shared_ptr<const EmbreeScene>);

EmbreeScene::EmbreeScene(const SceneObjects& objects)
  : device_(rtcNewDevice("threads=1"))
  , top_(makeScene(objects.staticObject.body->mesh()))
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
