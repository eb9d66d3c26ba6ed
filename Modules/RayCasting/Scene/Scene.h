// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ellipsoids/EllipsoidBound.h"
#include "Geometry/Ray.h"
#include "Geometry/TriangleIntersection.h"
#include "Kernels/BodyBalls.h"
#include "Meshes/SurfacePoint.h"
#include "Scene/RigidObject.h"
#include "Scene/TriangleNumbers.h"

#include <memory>
#include <utility>
#include <vector>

namespace irradiance
{

/// How the static and the dynamic geometry are searched. The hit found is the same.
enum class TraversalMode
{
  OneTree,    ///< all triangles in one tree, which every commit() rebuilds
  Sequential, ///< first the dynamic trees, then the static one up to the hit found
  Parallel    ///< likewise, but the static tree first beside many bodies or flattened objects
};

/**
 * The geometry of one frame: the static mesh (object 0) in a static tree, and the dynamic objects
 * (1, 2, ...). These are instanced (searched in their own trees behind their ellipsoids) or
 * flattened (triangle by triangle in a tree that every commit() rebuilds). A triangle of a dynamic
 * object is always tested in its own model space, whichever tree led to it, so that all modes find
 * the same bits. FrontCast casts its rays.
 */
class Scene
{
public:
  Scene();

  void setTraversalMode(TraversalMode mode) { mode_ = mode; }
  void setStatic(std::shared_ptr<const RigidObject> body) { static_ = std::move(body); }
  void setDynamic(const std::vector<PlacedBody>& objects) { objects_ = objects; }
  /// Rays may also start within these bounds, off all surfaces.
  void setPointSources(const Box& bounds) { pointSources_ = bounds; }
  /// Rebuilds the trees that depend on poses. `moved[i]` says whether FrontCast::castMoved()
  /// searches dynamic object i; empty means none. Call after any of the above and before any cast.
  void commit(const std::vector<bool>& moved, const CancelPoint& cancelPoint = {});

  /// The closest hits among all triangles.
  void cast(const Ray* rays, std::size_t count, Hit* hits) const;
  Hit cast(const Ray& ray) const
  {
    Hit hit;
    cast(&ray, 1, &hit);
    return hit;
  }

  /// Of all geometry, in world space.
  const Box& bounds() const { return bounds_; }
  /// The triangle in world space, its corners in the order of the mesh.
  Triangle worldTriangle(const TriangleId& id) const;
  /// The point of a hit from the front or from the back. The normal is turned to that side.
  SurfacePoint surfaceOf(const Hit& hit, bool isFront) const;
  /// The hit of a ray on this triangle, even if something lies before it.
  Hit hitOf(const Ray& ray, const TriangleId& id) const;
  /// No walk continues farther than this from where it hit, in world units (see SurfacePoint).
  double clearance() const;

  /// Contains all that a moved object can hide from a segment: the object, widened by the error of
  /// the distance of a grazing hit, and by `blur`, the position error of the segment.
  EllipsoidBound shadowBound(std::uint32_t index, double blur = 0) const;
  /// By how much that bound is wider than the object, in world units.
  double shadowPad(std::uint32_t index, double blur = 0) const
  {
    return placed_[index].roundTrip + placed_[index].slack + blur;
  }

private:
  struct Ball
  {
    Vector3 center;
    double squaredRadius;
    bool isTight; ///< the bound would reject hardly more
  };

  struct Placed
  {
    PlacedBody object;
    Matrix3 inverse;  ///< of the linear part
    double condition; ///< of the linear part
    double roundTrip; ///< error of a world position taken to model space and back, world units
    double slack;     ///< in world units: a hit may be this much closer than its triangle
    EllipsoidBound bound;
    Ball ball;              ///< around the bound; most segments miss it
    EllipsoidFilter filter; ///< of the bound, for lanes
  };

  /// Triangles of several objects in one tree, in world space.
  struct MixedTree
  {
    std::vector<std::uint32_t> objects;
    TriangleTree tree;
    std::vector<TriangleId> ids;
    std::vector<std::uint32_t> first; ///< for each object, its triangle 0 in `ids`, or kNone

    std::uint32_t referenceTo(const TriangleId& id) const
    {
      const bool isHere = id.object < first.size() && first[id.object] != TriangleId::kNone;
      return isHere ? first[id.object] + id.triangle : TriangleBlock::kNone;
    }
  };

  /// Up to so many bodies it is faster to go from one to the next.
  static constexpr std::size_t kFewBodies = 16;

  /// Some of the dynamic objects.
  struct Group
  {
    std::shared_ptr<const MixedTree> flattened; ///< null if there are none
    std::vector<std::uint32_t> instanced;       ///< indices in placed_
    // Of the instanced ones.
    BodyBalls balls;     ///< beyond kFewBodies
    TriangleTree bodies; ///< in place of the balls, beyond many

    bool isMany() const { return instanced.size() > kFewBodies; }
  };

  friend class FrontCast;

  static Ball ballAround(const EllipsoidBound& bound);
  void place(double magnitude);
  MixedTree mix(const std::vector<std::uint32_t>& objects, const CancelPoint& cancelPoint) const;
  Group group(const std::vector<bool>& chosen, const CancelPoint& cancelPoint) const;
  /// The triangles that are there.
  const TriangleMesh& meshOf(std::uint32_t object) const
  {
    return object == 0 ? static_->mesh() : placed_[object - 1].object.mesh();
  }
  const RigidObject& bodyOf(std::uint32_t object) const
  {
    return object == 0 ? *static_ : *placed_[object - 1].object.body;
  }
  /// A ray in the space of an object.
  Ray localRay(const Ray& ray, std::uint32_t object) const
  {
    if (object == 0)
    {
      return ray;
    }
    const Placed& placed = placed_[object - 1];
    return { placed.inverse * (ray.origin - placed.object.worldFromObject.translation),
      placed.inverse * ray.direction, ray.start };
  }
  const Triangle& localTriangle(const TriangleId& id) const
  {
    return bodyOf(id.object).mesh()[id.triangle];
  }
  /// False if the ray certainly misses the object up to a hit at `distance`, which may be infinite.
  bool mayTouch(const Placed& placed, const Ray& ray, double distance) const;

  TraversalMode mode_ = TraversalMode::Parallel;
  std::shared_ptr<const RigidObject> static_;
  std::vector<PlacedBody> objects_;
  std::vector<Placed> placed_;
  Box pointSources_;
  Box bounds_;
  TriangleNumbers numbers_; ///< whether objects are present or not
  Group dynamic_;
  Group moved_;
  MixedTree oneTree_;
};

}
