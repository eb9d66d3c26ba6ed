// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "EngineRun.h"
#include "Scene/Scene.h"
#include "Shooting/WalkStages.h"
#include "Shooting/WalkTracer.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <vector>

namespace irradiance::test
{

/// A scene, and the stages that take fronts of walks through it. Rays are cast by Scene::cast().
class FrontWorld
{
public:
  FrontWorld(const SceneObjects& objects, const WalkPlan& plan, std::uint64_t seed)
    : objects_(objects)
    , plan_(plan)
    , lights_(objects_, plan.most())
    , samples_(seed, plan.replicates())
    , triangles_(objects_)
    , stages_(objects_, triangles_, lights_, samples_)
    , tracer_(scene_, objects_, triangles_, lights_, samples_)
  {
    scene_.setStatic(objects_.staticObject.body);
    scene_.setDynamic(objects_.dynamicBodies());
    scene_.setPointSources(lights_.boundsInAir());
    scene_.commit({});
  }
  FrontWorld(const FrontWorld&) = delete;
  FrontWorld& operator=(const FrontWorld&) = delete;

  const SceneObjects& objects() const { return objects_; }
  const WalkPlan& plan() const { return plan_; }
  const LightTable& lights() const { return lights_; }
  const SobolSequence& samples() const { return samples_; }
  const SceneTriangles& triangles() const { return triangles_; }
  const WalkStages& stages() const { return stages_; }
  const Scene& scene() const { return scene_; }
  const WalkTracer& tracer() const { return tracer_; }

  /// Makes room for these walks and numbers them.
  void enter(WalkFront& front, std::uint32_t first, std::uint32_t count) const
  {
    front.reserve(count, stages_.bands());
    front.size = count;
    std::iota(front.walk.data(), front.walk.data() + count, first);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      front.block[i] = front.walk[i] / WalkPlan::kWalksPerBlock;
    }
  }

  Ray rayOf(const WalkFront& front, std::size_t i) const
  {
    return { Vector3(front.originX[i], front.originY[i], front.originZ[i]),
      Vector3(front.directionX[i], front.directionY[i], front.directionZ[i]),
      triangles_.idOf(front.start[i]) };
  }

  void cast(WalkFront& front) const
  {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < front.size; ++i)
    {
      rays.push_back(rayOf(front, i));
    }
    std::vector<Hit> hits(front.size);
    scene_.cast(rays.data(), rays.size(), hits.data());
    for (std::size_t i = 0; i < front.size; ++i)
    {
      front.distance[i] = hits[i].distance;
      front.hit[i] = triangles_.numberOf(hits[i].id);
      front.weightB[i] = hits[i].weights[0];
      front.weightC[i] = hits[i].weights[1];
      front.slot[i] = static_cast<std::uint32_t>(i);
    }
  }

  /// Who watches the walks sees each front before its rays are cast and after.
  using Watch = std::function<void(const WalkFront&)>;

  /// `expected`: photons.
  FrontTally tallyFor(CellSums& sums, PowerBalance& balance, std::size_t expected) const
  {
    return FrontTally(triangles_, sums, balance, stages_.powerPerWalk(), expected);
  }

  /// Takes all walks of the plan from their lights to their ends, so many at a time.
  void shoot(std::uint32_t together, FrontTally& tally, const Watch& leaving = {},
    const Watch& arriving = {}) const
  {
    const std::uint32_t first = plan_.rounds().front().firstWalk, end = plan_.endWalk();
    struct
    {
      WalkFront now, next;
    } fronts;
    for (std::uint32_t walk = first; walk < end; walk += together)
    {
      enter(fronts.now, walk, std::min(together, end - walk));
      stages_.start(fronts.now);
      tally.emit(fronts.now);
      while (fronts.now.size > 0)
      {
        if (leaving)
        {
          leaving(fronts.now);
        }
        cast(fronts.now);
        stages_.findSides(fronts.now);
        tally.receive(fronts.now);
        if (arriving)
        {
          arriving(fronts.now);
        }
        stages_.absorb(fronts.now, fronts.next);
        tally.release(fronts.next);
        stages_.leave(fronts.next);
        std::swap(fronts.now, fronts.next);
      }
    }
  }

private:
  SceneObjects objects_;
  WalkPlan plan_;
  LightTable lights_;
  SobolSequence samples_;
  SceneTriangles triangles_;
  WalkStages stages_;
  Scene scene_;
  WalkTracer tracer_;
};

}
