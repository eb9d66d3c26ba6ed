// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkTracer_h
#define irradiance_WalkTracer_h

#include "History/WalkHistory.h"
#include "Meshes/SurfacePoint.h"
#include "Scene/Scene.h"
#include "Shooting/WalkSampler.h"
#include "Surfaces/Contacts.h"

namespace irradiance
{

/// What decides how walks go on, and the scene in which they find their hits. So a walk is a pure function of
/// the scene, the samples and its number.
class WalkTracer
{
public:
  /// The arguments must outlive the tracer. `contacts`: null if nothing coincides with a lamp.
  WalkTracer(const Scene& scene, const SceneObjects& objects, const LightTable& lights,
    const SobolSequence& samples, const Contacts* contacts = nullptr)
    : scene_(scene)
    , sampler_(objects, lights, samples)
    , contacts_(contacts)
  {
  }

  const Scene& scene() const { return scene_; }
  const WalkSampler& sampler() const { return sampler_; }

  /// The hits of the rays: the closest triangles, and among triangles that coincide those that
  /// Contacts puts first.
  void cast(const Ray* rays, std::size_t count, Hit* hits) const;
  /// The hit of a ray whose closest hit among all triangles is known.
  Hit resolveContact(const Ray& ray, const Hit& closest) const
  {
    return contacts_ ? contacts_->resolveContact(scene_, ray, closest) : closest;
  }
  /// Whether the hit of a segment may depend on dynamic objects that touch its ends.
  bool isContact(const TriangleId& start, const TriangleId& hit) const
  {
    return hasContacts() && (contacts_->hasDynamic(start) || contacts_->hasDynamic(hit));
  }
  bool hasContacts() const { return contacts_ && !contacts_->isEmpty(); }
  /// Whether other triangles coincide with this one.
  bool hasContact(const TriangleId& id) const { return contacts_ && contacts_->has(id); }

  using Segments = std::vector<SegmentRef>;
  /// The rays of stored segments, the same as when they were shot unless they start on what has
  /// moved. `rays`: one for each.
  void raysOf(const WalkHistory& history, const Segments& segments, Ray* rays) const;
  /// The points where stored segments hit, and the unit directions in which they flew there. They
  /// follow from stored points as the directions of specular reflection do. Not for escapes.
  void arrivalsOf(const WalkHistory& history, const Segments& segments, SurfacePoint* points,
    Vector3* directions) const;
  /// The triangle on which a stored segment begins.
  TriangleId startOf(const WalkBlock& block, const SegmentRef& segment) const
  {
    return segment.bounce == 0 ? sampler_.lightOf(segment.walk).triangle()
                               : block.hit({ segment.walk, segment.bounce - 1 }).id;
  }
  /// Whether contacts affect a stored segment that has this hit.
  bool isTouching(const WalkBlock& block, const SegmentRef& segment, const Hit& hit) const
  {
    return block.isContact(segment) ||
      (hasContacts() && (isContact(startOf(block, segment), hit.id) || hasContact(hit.id)));
  }

private:
  /// Calls set(i, ray) with the first ray of the walk of each segment i of `which`.
  template <class Set>
  void forEachStart(
    const Segments& segments, const std::vector<std::size_t>& which, const Set& set) const;
  /// Where the rays of stored segments begin.
  void originsOf(const WalkHistory& history, const Segments& segments, Vector3* origins) const;
  ScatteredRay scatteredRayOf(const WalkHistory& history, const SegmentRef& segment) const;

  const Scene& scene_;
  WalkSampler sampler_;
  const Contacts* contacts_;
};

}

#endif
