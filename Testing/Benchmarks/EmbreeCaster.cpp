#include "EmbreeCaster.h"

#include <algorithm>
#include <iterator>
#include <limits>

#ifdef __SSE2__
#include <pmmintrin.h>
#endif

using namespace irradiance;

namespace
{

constexpr float kFar = std::numeric_limits<float>::infinity();

RTCIntersectContext makeContext()
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

Hit makeHit(float distance, std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive)
{
  if (geometry == RTC_INVALID_GEOMETRY_ID)
  {
    return {};
  }
  return { distance, { instance == RTC_INVALID_GEOMETRY_ID ? 0 : instance, primitive } };
}

}

EmbreeCaster::EmbreeCaster(
  std::string name, std::shared_ptr<const EmbreeScene> scene, RaysPerCall raysPerCall)
  : Caster(std::move(name))
  , scene_(std::move(scene))
  , raysPerCall_(raysPerCall)
{
}

void EmbreeCaster::setRays(const std::vector<Ray>& rays)
{
  rays_.resize(rays.size());
  std::transform(rays.begin(), rays.end(), rays_.begin(), [](const Ray& ray) {
    FloatRay copy;
    Eigen::Map<Eigen::Vector3f>(copy.origin) = ray.origin.cast<float>();
    Eigen::Map<Eigen::Vector3f>(copy.direction) = ray.direction.cast<float>();
    return copy;
  });
}

void EmbreeCaster::cast(std::vector<Hit>& hits)
{
  switch (raysPerCall_)
  {
    case RaysPerCall::One:
      return castOneByOne(hits);
    case RaysPerCall::Eight:
      return castPackets<RTCRayHit8>(rtcIntersect8, hits);
    case RaysPerCall::Sixteen:
      return castPackets<RTCRayHit16>(rtcIntersect16, hits);
  }
}

void EmbreeCaster::castOneByOne(std::vector<Hit>& hits) const
{
  RTCIntersectContext context = makeContext();
  for (std::size_t i = 0; i < rays_.size(); ++i)
  {
    const FloatRay& ray = rays_[i];
    RTCRayHit query;
    query.ray.org_x = ray.origin[0];
    query.ray.org_y = ray.origin[1];
    query.ray.org_z = ray.origin[2];
    query.ray.dir_x = ray.direction[0];
    query.ray.dir_y = ray.direction[1];
    query.ray.dir_z = ray.direction[2];
    query.ray.tnear = 0;
    query.ray.tfar = kFar;
    query.ray.time = 0;
    query.ray.mask = ~0u;
    query.ray.flags = 0;
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_->top(), &context, &query);
    hits[i] = makeHit(query.ray.tfar, query.hit.instID[0], query.hit.geomID, query.hit.primID);
  }
}

template <typename Packet, typename Intersect>
void EmbreeCaster::castPackets(Intersect intersect, std::vector<Hit>& hits) const
{
  constexpr std::size_t kWidth = sizeof(Packet::ray.org_x) / sizeof(float);
  RTCIntersectContext context = makeContext();
  for (std::size_t first = 0; first < rays_.size(); first += kWidth)
  {
    const std::size_t count = std::min(kWidth, rays_.size() - first);
    alignas(64) Packet packet;
    alignas(64) int valid[kWidth];
    for (std::size_t k = 0; k < kWidth; ++k)
    {
      const FloatRay& ray = rays_[first + std::min(k, count - 1)];
      valid[k] = k < count ? -1 : 0;
      packet.ray.org_x[k] = ray.origin[0];
      packet.ray.org_y[k] = ray.origin[1];
      packet.ray.org_z[k] = ray.origin[2];
      packet.ray.dir_x[k] = ray.direction[0];
      packet.ray.dir_y[k] = ray.direction[1];
      packet.ray.dir_z[k] = ray.direction[2];
      packet.ray.tnear[k] = 0;
      packet.ray.tfar[k] = kFar;
      packet.ray.time[k] = 0;
      packet.ray.mask[k] = ~0u;
      packet.ray.flags[k] = 0;
      packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(valid, scene_->top(), &context, &packet);
    for (std::size_t k = 0; k < count; ++k)
    {
      hits[first + k] = makeHit(
        packet.ray.tfar[k], packet.hit.instID[0][k], packet.hit.geomID[k], packet.hit.primID[k]);
    }
  }
}

void flushDenormals()
{
#ifdef __SSE2__
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}
