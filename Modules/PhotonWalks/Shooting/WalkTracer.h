// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/FrontCast.h"
#include "Shooting/WalkStages.h"
#include "Surfaces/Contacts.h"

#include <algorithm>

namespace irradiance
{

/// What decides how walks go on, and the scene in which they find their hits. So a walk is a pure
/// function of the scene, the samples and its number.
class WalkTracer
{
public:
  /// The arguments must outlive the tracer. `contacts`: null if nothing coincides with a lamp.
  /// `gathered`: see WalkStages.
  WalkTracer(const Scene& scene, const SceneObjects& objects, const SceneTriangles& triangles,
    const LightTable& lights, const SobolSequence& samples, const Contacts* contacts = nullptr,
    const DirectRounds* gathered = nullptr)
    : scene_(scene)
    , triangles_(triangles)
    , stages_(objects, triangles, lights, samples, gathered)
    , contacts_(contacts)
    , gathered_(gathered)
  {
  }
  WalkTracer(const WalkTracer&) = delete;
  WalkTracer& operator=(const WalkTracer&) = delete;

  const Scene& scene() const { return scene_; }
  const SceneTriangles& triangles() const { return triangles_; }
  const WalkStages& stages() const { return stages_; }

  // Each finds the hits of the rays of a front: the closest triangles, and among triangles that
  // coincide those that Contacts puts first. `cast`: owns the memory of the stages.
  /// Among all triangles. Writes distance, hit and weights.
  void cast(WalkFront& front, FrontCast& cast) const
  {
    std::fill_n(front.distance.data(), front.size, kInfinity);
    std::fill_n(front.hit.data(), front.size, WalkFront::kNone);
    cast.cast(scene_, triangles_.surfaces(), raysOf(front));
    resolveContacts(front);
  }
  /// Among dynamic triangles, if they are closer than what stands in the front.
  void castDynamic(WalkFront& front, FrontCast& cast) const
  {
    cast.castDynamic(scene_, triangles_.surfaces(), raysOf(front));
    resolveContacts(front);
  }
  /// Likewise, among those of objects that moved. Only rows with another hit are asked for
  /// contacts.
  void castMoved(WalkFront& front, FrontCast& cast) const
  {
    std::copy_n(front.hit.data(), front.size, front.candidate.data());
    cast.castMoved(scene_, triangles_.surfaces(), raysOf(front));
    for (std::size_t row = 0; hasContacts() && row < front.size; ++row)
    {
      if (front.hit[row] != front.candidate[row])
      {
        resolveContact(front, row);
      }
    }
  }
  /// Sets the distances and weights of hits that are known.
  void findDistances(WalkFront& front, FrontCast& cast) const
  {
    cast.findDistances(scene_, triangles_.surfaces(), raysOf(front));
  }

  /// Whether the hit of a segment may depend on dynamic objects that touch its ends. Numbers of
  /// triangles.
  bool isContact(std::uint32_t start, std::uint32_t hit) const
  {
    return hasContacts() &&
      (contacts_->hasDynamic(triangles_.idOf(start)) ||
        contacts_->hasDynamic(triangles_.idOf(hit)));
  }
  bool hasContacts() const { return contacts_ && !contacts_->isEmpty(); }
  /// Whether other triangles coincide with this one.
  bool hasContact(std::uint32_t triangle) const
  {
    return hasContacts() && contacts_->has(triangles_.idOf(triangle));
  }
  /// The power of every walk, if there is one band.
  Power powerPerWalk() const
  {
    return gathered_ ? Power{ { gathered_->quantaPerWalk() } } : stages_.powerPerWalk();
  }
  /// Whether walks start where direct light was gathered.
  bool startsAtCells() const { return gathered_ != nullptr; }
  /// The number of the triangle that a walk leaves first, or kNone.
  std::uint32_t startOf(std::uint32_t walk) const
  {
    return gathered_ ? gathered_->sampleOf(walk).triangle
                     : triangles_.numberOf(stages_.lightOf(walk).triangle());
  }
  Ray rayOf(const WalkFront& front, std::size_t row) const
  {
    return { { front.originX[row], front.originY[row], front.originZ[row] },
      { front.directionX[row], front.directionY[row], front.directionZ[row] },
      triangles_.idOf(front.start[row]) };
  }

private:
  static TreeRays raysOf(WalkFront& front)
  {
    return { static_cast<std::uint32_t>(front.size),
      { front.originX.data(), front.originY.data(), front.originZ.data() },
      { front.directionX.data(), front.directionY.data(), front.directionZ.data() },
      { nullptr, nullptr, nullptr }, front.start.data(), front.distance.data(), front.hit.data(),
      { front.weightB.data(), front.weightC.data() } };
  }
  void resolveContacts(WalkFront& front) const
  {
    for (std::size_t row = 0; hasContacts() && row < front.size; ++row)
    {
      resolveContact(front, row);
    }
  }
  void resolveContact(WalkFront& front, std::size_t row) const
  {
    const TriangleId start = triangles_.idOf(front.start[row]),
                     id = triangles_.idOf(front.hit[row]);
    if (!contacts_->has(start) && !contacts_->has(id))
    {
      return;
    }
    const Hit closest{ front.distance[row], id, { front.weightB[row], front.weightC[row] } };
    const Hit hit = contacts_->resolveContact(scene_, rayOf(front, row), closest);
    front.distance[row] = hit.distance;
    front.hit[row] = triangles_.numberOf(hit.id);
    front.weightB[row] = hit.weights[0];
    front.weightC[row] = hit.weights[1];
  }

  const Scene& scene_;
  const SceneTriangles& triangles_;
  WalkStages stages_;
  const Contacts* contacts_;
  const DirectRounds* gathered_;
};

}
