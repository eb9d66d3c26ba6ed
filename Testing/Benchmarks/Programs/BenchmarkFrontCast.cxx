// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the cast of a front costs: all rays of some 4,096 walks together, in columns, beside
 * Scene::cast with the making of its rays, and beside Embree, sixteen rays a call. All cast the
 * same photon rays, from anywhere on the surfaces of the plain room, in which two bodies hang. One
 * thread, in turns in one process; before any time counts, the hits of the front must be those of
 * Scene::cast, bit for bit, and Embree's about the same.
 *
 * Arguments: [fronts = 64] [rounds = 15]
 */
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Measuring/TimedStages.h"
#include "Rivals/EmbreeRays.h"
#include "Rivals/OurCaster.h"
#include "Scene/FrontCast.h"
#include "Scenes/BenchmarkScene.h"
#include "Scenes/PlainRoom.h"

#include "../../RayCasting/RandomVectors.h"
#include "../../RayCasting/TestFronts.h"

#include <cstring>
#include <memory>
#include <stdexcept>

using namespace irradiance;

namespace
{

constexpr std::uint32_t kFront = 4096; ///< rays

const std::string kTable = "FrontCast";

/// The rays of photons that bounce, each with the triangle that it leaves.
std::vector<Ray> photonRays(
  const SceneObjects& objects, const SurfaceRecords& records, std::uint32_t count)
{
  const std::vector<Triangle> triangles = worldTriangles(objects);
  std::vector<double> upTo;
  for (const Triangle& triangle : triangles)
  {
    upTo.push_back((upTo.empty() ? 0 : upTo.back()) + triangle.area());
  }
  test::RandomVectors random(1);
  std::vector<Ray> rays;
  while (rays.size() < count)
  {
    const auto found =
      std::upper_bound(upTo.begin(), upTo.end() - 1, random.uniform(0, upTo.back()));
    const auto number = static_cast<std::uint32_t>(found - upTo.begin());
    const double s = std::sqrt(random.uniform(0, 1)), t = random.uniform(0, 1);
    // Fronts face the room.
    const SurfacePoint point = surfacePoint(triangles[number], { 1 - s, s * (1 - t), s * t });
    // A point of a ball that touches the surface: cosine-distributed.
    rays.push_back(test::asInFront({ point.clearPosition(), point.normal + random.direction(),
      records.numbers().idOf(number) }));
  }
  return rays;
}

/// The same rays, front by front.
struct Fronts
{
  std::vector<std::vector<Ray>> rays;
  std::vector<std::vector<Hit>> hits;
  std::vector<test::TestFront> columns;

  Fronts(const std::vector<Ray>& all, const SurfaceRecords& records)
  {
    for (auto first = all.begin(); first != all.end(); first += kFront)
    {
      rays.emplace_back(first, first + kFront);
      hits.emplace_back(kFront);
      columns.emplace_back(records);
      columns.back().set(rays.back(), hits.back());
    }
  }

  std::size_t size() const { return rays.size(); }
};

void forgetHits(const FrontRays& front)
{
  std::fill_n(front.distance, front.count, kInfinity);
  std::fill_n(front.hit, front.count, TriangleId::kNone);
}

void castFronts(FrontCast& cast, const Scene& scene, const SurfaceRecords& records, Fronts& fronts)
{
  for (test::TestFront& front : fronts.columns)
  {
    forgetHits(front.columns());
    cast.cast(scene, records, front.columns());
  }
}

/// As a shooter does that keeps its walks in columns: rays are made of them, and their hits put
/// back.
void castByScene(const Scene& scene, const SurfaceRecords& records, Fronts& fronts)
{
  for (std::size_t i = 0; i < fronts.size(); ++i)
  {
    const FrontRays front = fronts.columns[i].columns();
    std::vector<Ray>& rays = fronts.rays[i];
    for (std::uint32_t k = 0; k < front.count; ++k)
    {
      rays[k] = { { front.origin[0][k], front.origin[1][k], front.origin[2][k] },
        { front.direction[0][k], front.direction[1][k], front.direction[2][k] },
        records.numbers().idOf(front.start[k]) };
    }
    scene.cast(rays.data(), rays.size(), fronts.hits[i].data());
  }
}

void check(const Fronts& fronts, EmbreeRays<RTCRayHit16>& embree)
{
  std::size_t wrong = 0, apart = 0, all = 0;
  for (std::size_t i = 0; i < fronts.size(); ++i)
  {
    for (std::size_t k = 0; k < kFront; ++k, ++all)
    {
      const Hit &ours = fronts.hits[i][k], front = fronts.columns[i].hit(k);
      wrong += front != ours || front.weights != ours.weights ? 1 : 0;
      const Hit other = embree.hit(all);
      const bool isNear = bool(ours) == bool(other) &&
        (!ours || std::abs(other.distance - ours.distance) < 1e-4 * ours.distance);
      apart += isNear ? 0 : 1;
    }
  }
  if (wrong > 0 || apart > all / 500)
  {
    throw std::runtime_error("Of " + std::to_string(all) + " hits, " + std::to_string(wrong) +
      " of fronts are wrong, and " + std::to_string(apart) + " of Embree are elsewhere");
  }
}

}

void run(const Arguments& arguments)
{
  const auto numberOfFronts = arguments.number(0, 64u);
  const int rounds = arguments.number(1, 15);
  MovingScene room = makePlainRoom();
  room.place(room.objects, 0.0);
  const auto scene = makeScene(room.objects);
  SurfaceRecords records;
  records.update(room.objects.staticObject.body, room.objects.dynamicBodies());

  const std::vector<Ray> rays = photonRays(room.objects, records, numberOfFronts * kFront);
  Fronts fronts(rays, records);
  const EmbreeScene embreeScene(room.objects);
  EmbreeRays<RTCRayHit16> embree(embreeScene, rays.size(), embreeScene.nearest());
  const auto castByEmbree = [&] {
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      embree.set(i, rays[i].origin.cast<float>(), rays[i].direction.cast<float>());
    }
    const double begin = threadCpuSeconds();
    embree.cast(rays.size());
    return threadCpuSeconds() - begin;
  };
  FrontCast cast;
  const double perRay = 1e9 / static_cast<double>(rays.size());
  const std::vector<std::pair<std::string, SimdLevel>> levels = { { "", SimdLevel::Avx512 },
    { ", AVX2", SimdLevel::Avx2 }, { ", plain", SimdLevel::Plain } };
  for (int round = -1; round < rounds; ++round)
  {
    const double embreeTime = perRay * castByEmbree();
    for (const auto& [name, level] : levels)
    {
      limitSimd(level);
      const double front =
        perRay * threadCpuSecondsOf([&] { castFronts(cast, *scene, records, fronts); });
      const double single =
        perRay * threadCpuSecondsOf([&] { castByScene(*scene, records, fronts); });
      check(fronts, embree);
      const TimedStages times;
      castFronts(cast, *scene, records, fronts);
      if (round < 0)
      {
        continue;
      }
      report(kTable, "front" + name, "ns a ray", front);
      report(kTable, "Scene::cast" + name, "ns a ray", single);
      report(kTable, "front" + name, "speed / Scene::cast", single / front);
      report(kTable, "front" + name, "speed / rtcIntersect16", embreeTime / front);
      const std::pair<const char*, Stage> stages[] = { { "pre-test", Stage::PreTest },
        { "prepare", Stage::Prepare }, { "search", Stage::Search }, { "confirm", Stage::Confirm } };
      for (const auto& [stageName, stage] : stages)
      {
        report(kTable, "front" + name, std::string(stageName) + ", ns a ray",
          times.of(stage) / static_cast<double>(rays.size()));
      }
    }
    if (round >= 0)
    {
      report(kTable, "Embree rtcIntersect16", "ns a ray", embreeTime);
    }
  }
  limitSimd(SimdLevel::Avx512);
}
