// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkShooter_h
#define irradiance_WalkShooter_h

#include "History/WalkBlock.h"
#include "Light/Contacts.h"
#include "Light/Emitter.h"
#include "Scene/Scene.h"

namespace irradiance
{

/// What a walk does at its start and at each hit. A walk is a pure function of the scene, the
/// samples and its number.
class WalkShooter
{
public:
  /// The arguments must outlive the shooter. `contacts`: null if nothing coincides with a lamp.
  WalkShooter(const Scene& scene, const SceneObjects& objects, const EmitterTable& emitters,
    const SobolSequence& samples, const Contacts* contacts = nullptr)
    : scene_(scene)
    , objects_(objects)
    , emitters_(emitters)
    , samples_(samples)
    , contacts_(contacts)
  {
  }

  const Scene& scene() const { return scene_; }
  WalkStart start(std::uint32_t walk) const { return emitters_.start(walk, samples_); }

  /// The hits of the rays: the closest triangles, and among triangles that coincide those that
  /// Contacts puts first.
  void cast(const Ray* rays, std::size_t count, Hit* hits) const;
  /// The hit of a ray whose closest hit among all triangles is known.
  Hit settled(const Ray& ray, const Hit& closest) const
  {
    return contacts_ ? contacts_->settled(scene_, ray, closest) : closest;
  }
  /// Whether the hit of a segment may depend on dynamic objects that touch its ends.
  bool isContact(const TriangleId& start, const TriangleId& hit) const
  {
    return contacts_ && (contacts_->hasDynamic(start) || contacts_->hasDynamic(hit));
  }
  /// Whether other triangles coincide with this one.
  bool hasContact(const TriangleId& id) const { return contacts_ && contacts_->has(id); }

  /// The power with which a walk leaves the hit of segment `bounce`; zero if it ends there.
  Power powerAfter(
    std::uint32_t walk, std::uint32_t bounce, const TriangleId& id, const Power& incoming) const;
  /// The ray of segment `bounce`, with which a walk leaves its hit at `point` of triangle `id`.
  Ray rayFrom(std::uint32_t walk, std::uint32_t bounce, const SurfacePoint& point,
    const TriangleId& id) const;

  /// The ray of a stored segment, the same as when it was shot unless it starts on what has moved.
  Ray rayOf(const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk,
    std::uint32_t bounce) const;

  /// Prefetch what surfaceAt() and powerAfter() will read. prefetchCell() is for later, as it reads
  /// what prefetchTriangle() requested.
  void prefetchTriangle(const Hit& hit) const;
  void prefetchCell(const Hit& hit) const;

private:
  const Scene& scene_;
  const SceneObjects& objects_;
  const EmitterTable& emitters_;
  const SobolSequence& samples_;
  const Contacts* contacts_;
};

}

#endif
