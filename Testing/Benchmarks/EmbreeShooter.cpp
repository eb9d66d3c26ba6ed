#include "EmbreeShooter.h"

#include "EmbreeRays.h"
#include "EmbreeWalks.h"

using namespace irradiance;

namespace
{

/// The walks of a batch, as many as the engine's. From 256 to 16384 the times hardly differ.
constexpr std::uint32_t kBatch = 1024;

std::int64_t shootWalkByWalk(const EmbreeScene& embree, EmbreeWalks& walks)
{
  std::int64_t segments = 0;
  EmbreeRays<RTCRayHit> rays(embree, 1);
  for (std::uint32_t i = 0; i < walks.numberOfWalks(); ++i)
  {
    Ray ray;
    EmbreeWalk walk = walks.start(i, ray);
    TriangleId id;
    do
    {
      rays.set(0, ray);
      rays.cast(1);
      ++segments;
      id = rays.id(0);
    } while (
      id != TriangleId{} && walks.reportProgress(walk, ray.direction, id, rays.weights(0), ray));
  }
  return segments;
}

/// From the hits of the walks to their next rays; returns how many walks go on.
template <class Packet>
std::size_t goOn(
  std::vector<EmbreeWalk>& batch, std::size_t count, EmbreeRays<Packet>& rays, EmbreeWalks& walks)
{
  constexpr std::size_t kAhead = 8;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i + 2 * kAhead < count)
    {
      walks.prefetchTriangle(rays.id(i + 2 * kAhead));
    }
    if (i + kAhead < count)
    {
      walks.prefetchCell(rays.id(i + kAhead));
    }
    const TriangleId id = rays.id(i);
    EmbreeWalk walk = batch[i];
    Ray ray;
    if (id != TriangleId{} &&
      walks.reportProgress(walk, rays.direction(i), id, rays.weights(i), ray))
    {
      rays.set(kept, ray); // the hit that stood here has been read
      batch[kept++] = walk;
    }
  }
  return kept;
}

template <class Packet>
std::int64_t shootInBatches(const EmbreeScene& embree, EmbreeWalks& walks)
{
  std::int64_t segments = 0;
  EmbreeRays<Packet> rays(embree, kBatch);
  std::vector<EmbreeWalk> batch(kBatch);
  for (std::uint32_t first = 0; first < walks.numberOfWalks(); first += kBatch)
  {
    std::size_t count = std::min(kBatch, walks.numberOfWalks() - first);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      Ray ray;
      batch[i] = walks.start(first + i, ray);
      rays.set(i, ray);
    }
    while (count > 0)
    {
      segments += static_cast<std::int64_t>(count);
      rays.cast(count);
      count = goOn(batch, count, rays, walks);
    }
  }
  return segments;
}

}

const char* nameOf(EmbreeForm form)
{
  switch (form)
  {
    case EmbreeForm::WalkByWalk:
      return "rtcIntersect1, walk by walk";
    case EmbreeForm::Batch1:
      return "rtcIntersect1, in batches";
    case EmbreeForm::Batch8:
      return "rtcIntersect8, in batches";
    case EmbreeForm::Batch16:
      return "rtcIntersect16, in batches";
  }
  return "";
}

std::int64_t shootWithEmbree(EmbreeForm form, const EmbreeScene& embree,
  const SceneObjects& objects, std::uint32_t numberOfWalks, std::uint64_t seed, CellSums& sums)
{
  EmbreeWalks walks(objects, numberOfWalks, seed, sums);
  switch (form)
  {
    case EmbreeForm::WalkByWalk:
      return shootWalkByWalk(embree, walks);
    case EmbreeForm::Batch1:
      return shootInBatches<RTCRayHit>(embree, walks);
    case EmbreeForm::Batch8:
      return shootInBatches<RTCRayHit8>(embree, walks);
    case EmbreeForm::Batch16:
      return shootInBatches<RTCRayHit16>(embree, walks);
  }
  return 0;
}
