#ifndef irradiance_Scene_h
#define irradiance_Scene_h

#include "EllipsoidBound.h"
#include "KdTraversal.h"
#include "RigidObject.h"
#include "SurfacePoint.h"
#include "TriangleIntersection.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// How the static and the dynamic geometry are searched; the hit found is the same.
enum class TraversalMode
{
  OneTree,    ///< all triangles in one tree, rebuilt when anything moves
  Sequential, ///< first the dynamic tree, then the static one up to the hit found
  Parallel    ///< both trees side by side, always the one whose next node is nearer
};

/// A dynamic object and its pose in this frame.
struct PlacedObject
{
  std::shared_ptr<const RigidObject> body;
  AffineMap worldFromObject;
  bool isLoose = false; ///< its triangles stand in the dynamic tree one by one
};

/**
 * The geometry of one frame: the static mesh (object 0) in a static tree, and the dynamic objects
 * (1, 2, ...) in a dynamic tree, which is rebuilt from their bounds when one of them moves. A
 * triangle of a dynamic object is always tested in its own model space, whichever tree led to it,
 * so that all modes find the same bits.
 */
class Scene
{
public:
  Scene();

  void setTraversalMode(TraversalMode mode) { mode_ = mode; }
  void setStatic(std::shared_ptr<const RigidObject> body);
  void setDynamic(const std::vector<PlacedObject>& objects);
  /// Rays may start here besides on surfaces.
  void setPointSources(const Box& bounds) { pointSources_ = bounds; }
  /// Rebuilds the trees that depend on poses. `moved[i]` marks the dynamic objects that the
  /// verification has to look at. Call after any of the above, before any cast.
  void commit(const std::vector<bool>& moved, const Checkpoint& checkpoint = {});

  /// The closest hit among all triangles.
  Hit cast(const Ray& ray) const;
  /// The closest hit in the static tree that is closer than `best`, else `best`. The caller knows
  /// that there is none before `from`.
  Hit castStatic(const Ray& ray, Hit best, double from = 0) const;
  /// The same among all dynamic objects.
  Hit castDynamic(const Ray& ray, Hit best) const;
  /// The same among the objects marked as moved.
  Hit castMoved(const Ray& ray, Hit best) const;
  /// False if no moved object touches the ray up to `distance`; true is no promise. Cheap.
  /// `direction` must be a unit vector.
  bool movedMayTouch(const Vector3& origin, const Vector3& direction, double distance) const;

  std::size_t numberOfObjects() const { return placed_.size(); }
  /// The triangle in world space, with the corners in the order of the mesh.
  Triangle worldTriangle(const TriangleId& id) const;
  /// Where a ray met its hit; the normal is turned to the side from which the ray came.
  SurfacePoint surfaceAt(const Ray& ray, const Hit& hit) const;

private:
  struct Placed
  {
    PlacedObject object;
    Matrix3 inverse;  ///< of the linear part
    double roundTrip; ///< error of a world position taken to model space and back
    EllipsoidBound bound;

    Vector3 toObject(const Vector3& point) const
    {
      return inverse * (point - object.worldFromObject.translation);
    }
  };

  /// What a reference of a top-level tree stands for.
  struct Entry
  {
    static constexpr std::uint32_t kWhole = 0xffffffffu;
    std::uint32_t object;
    std::uint32_t triangle; ///< or kWhole: the object's own tree
  };

  struct TopTree
  {
    KdTree tree;
    std::vector<Entry> entries;
  };

  class TopCast;

  void markMoved(const std::vector<bool>& moved);
  void place(double magnitude);
  void addEntries(std::uint32_t object, bool asTriangles, TopTree& top,
    std::vector<KdPrimitive>& primitives, std::vector<Triangle>& world) const;
  TopTree buildTop(const std::vector<bool>& chosen, bool withStatic, const Checkpoint&) const;
  const TriangleMesh& meshOf(std::uint32_t object) const;
  /// The ray in the space of the object.
  ShearedRay shearedFor(const Ray& ray, std::uint32_t object) const;
  Hit castTop(const TopTree& top, const Ray& ray, Hit best) const;
  Hit castParallel(const Ray& ray) const;

  TraversalMode mode_ = TraversalMode::Parallel;
  std::shared_ptr<const RigidObject> static_;
  std::vector<PlacedObject> objects_;
  std::vector<Placed> placed_;
  /// A moved object, and a ball around it that most segments miss.
  struct Moved
  {
    std::uint32_t index; ///< in placed_
    Vector3 center;
    double squaredRadius;
  };

  std::vector<Moved> moved_; ///< those with triangles
  Box pointSources_;
  double reach_ = 0; ///< from any place where a ray starts, everything is closer
  TopTree dynamicTree_;
  TopTree movedTree_;
  TopTree oneTree_;
};

}

#endif
