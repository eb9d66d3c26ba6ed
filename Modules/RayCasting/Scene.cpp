#include "Scene.h"

#include <Eigen/LU>

#include <algorithm>

namespace irradiance
{

namespace
{

void keepCloser(Hit& best, double distance, std::uint32_t object, std::uint32_t triangle)
{
  const Hit hit{ distance, { object, triangle } };
  if (isCloser(hit, best))
  {
    best = hit;
  }
}

/// One leaf of a triangle tree.
void testLeaf(const KdTraversal& leaf, const TriangleMesh& mesh, const ShearedRay& ray,
  std::uint32_t object, const TriangleId& start, Hit& best)
{
  for (const std::uint32_t triangle : leaf)
  {
    double distance;
    if (ray.meets(mesh[triangle], distance) && distance <= best.distance &&
      TriangleId{ object, triangle } != start)
    {
      keepCloser(best, distance, object, triangle);
    }
  }
}

void castMesh(const RigidObject& body, const Vector3& origin, const Vector3& direction,
  std::uint32_t object, const TriangleId& start, Hit& best, double from = 0)
{
  KdTraversal traversal(body.tree(), origin, direction, from);
  if (traversal.isFinished())
  {
    return;
  }
  const ShearedRay sheared(origin, direction);
  while (traversal.advance(traversal.limit(best.distance)))
  {
    testLeaf(traversal, body.mesh(), sheared, object, start, best);
  }
}

/// How far world positions may be off after the way to model space and back: a few ulps times the
/// condition of the map. 2^-44 leaves room for sums of a few hundred such errors.
double roundTripError(const AffineMap& map, const Matrix3& inverse, double magnitude)
{
  const double condition = (map.linear.cwiseAbs() * inverse.cwiseAbs()).rowwise().sum().maxCoeff();
  return 0x1p-44 * std::max(1.0, condition) * (magnitude + map.translation.cwiseAbs().maxCoeff());
}

/// How far to look for hits that might come before one at `distance`; nothing is beyond `reach`.
double lookAhead(double distance, double reach)
{
  return std::min(distance + KdTraversal::kSlack * reach, reach);
}

Box boundsOf(const AffineMap& map, const Box& box)
{
  Box bounds;
  for (int corner = 0; corner < 8 && !box.isEmpty(); ++corner)
  {
    bounds.add(map(Vector3(corner & 1 ? box.upper[0] : box.lower[0],
      corner & 2 ? box.upper[1] : box.lower[1], corner & 4 ? box.upper[2] : box.lower[2])));
  }
  return bounds;
}

}

/// Tests the entries of a top-level tree along one ray. An object stands in many leaves: the last
/// ones entered are remembered, and so is the ray in the space of the last object.
class Scene::TopCast
{
public:
  TopCast(const Scene& scene, const TopTree& top, const Ray& ray)
    : scene_(scene)
    , top_(top)
    , ray_(ray)
    , reach_(2 * farthest(top.tree.bounds) / ray.direction.cwiseAbs().maxCoeff())
    , sheared_(ray.origin, ray.direction)
  {
    std::fill(std::begin(entered_), std::end(entered_), Entry::kWhole);
  }

  void testLeaf(const KdTraversal& leaf, Hit& best)
  {
    for (const std::uint32_t reference : leaf)
    {
      const Entry& entry = top_.entries[reference];
      if (entry.triangle == Entry::kWhole)
      {
        enter(entry.object, best);
      }
      else
      {
        testTriangle(entry, best);
      }
    }
  }

private:
  double farthest(const Box& bounds) const
  {
    return bounds.isEmpty() ? 0.0
                            : std::max((bounds.lower - ray_.origin).cwiseAbs().maxCoeff(),
                                (bounds.upper - ray_.origin).cwiseAbs().maxCoeff());
  }

  void enter(std::uint32_t object, Hit& best)
  {
    std::uint32_t& last = entered_[object % kRemembered];
    if (last == object)
    {
      return;
    }
    last = object;
    const Placed& placed = scene_.placed_[object - 1];
    const double length = lookAhead(best.distance, reach_);
    if (!placed.bound.rejects(ray_.origin, ray_.origin + length * ray_.direction))
    {
      castMesh(*placed.object.body, placed.toObject(ray_.origin), placed.inverse * ray_.direction,
        object, ray_.start, best);
    }
  }

  void testTriangle(const Entry& entry, Hit& best)
  {
    if (entry.object != shearedObject_)
    {
      shearedObject_ = entry.object;
      sheared_ = scene_.shearedFor(ray_, entry.object);
    }
    double distance;
    if (sheared_.meets(scene_.meshOf(entry.object)[entry.triangle], distance) &&
      TriangleId{ entry.object, entry.triangle } != ray_.start)
    {
      keepCloser(best, distance, entry.object, entry.triangle);
    }
  }

  static constexpr std::uint32_t kRemembered = 8;

  const Scene& scene_;
  const TopTree& top_;
  const Ray& ray_;
  double reach_; ///< everything is closer
  std::uint32_t entered_[kRemembered];
  std::uint32_t shearedObject_ = 0;
  ShearedRay sheared_;
};

Scene::Scene()
  : static_(std::make_shared<RigidObject>(TriangleMesh()))
{
}

void Scene::setStatic(std::shared_ptr<const RigidObject> body)
{
  static_ = std::move(body);
}

void Scene::setDynamic(const std::vector<PlacedObject>& objects)
{
  objects_ = objects;
}

void Scene::commit(const std::vector<bool>& moved, const Checkpoint& checkpoint)
{
  Box world = static_->mesh().bounds();
  world.add(pointSources_);
  for (const PlacedObject& object : objects_)
  {
    world.add(boundsOf(object.worldFromObject, object.body->mesh().bounds()));
  }
  place(world.magnitude());
  // Rays start on surfaces or at point sources, up to a margin far below one in a million.
  reach_ = 1.01 * world.extent().norm() + 0x1p-20 * world.magnitude();
  markMoved(moved);

  dynamicTree_ = buildTop(std::vector<bool>(objects_.size(), true), false, checkpoint);
  movedTree_ = moved.empty() ? TopTree{} : buildTop(moved, false, checkpoint);
  oneTree_ = mode_ == TraversalMode::OneTree && !objects_.empty()
    ? buildTop(std::vector<bool>(objects_.size(), true), true, checkpoint)
    : TopTree{};
}

void Scene::markMoved(const std::vector<bool>& moved)
{
  moved_.clear();
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    if (moved[i] && !objects_[i].body->mesh().isEmpty())
    {
      const Box& box = placed_[i].bound.worldBox();
      // The second factor is for the rounding in movedMayTouch(), far below the box's own margin.
      moved_.push_back({ i, box.center(), 0.25 * box.extent().squaredNorm() * (1 + 0x1p-20) });
    }
  }
}

void Scene::place(double magnitude)
{
  placed_.clear();
  for (const PlacedObject& object : objects_)
  {
    const Matrix3 inverse = object.worldFromObject.linear.inverse();
    const double error = roundTripError(object.worldFromObject, inverse, magnitude);
    placed_.push_back({ object, inverse, error,
      EllipsoidBound(
        object.body->ellipsoid(), object.body->mesh().bounds(), object.worldFromObject, error) });
  }
}

const TriangleMesh& Scene::meshOf(std::uint32_t object) const
{
  return object == 0 ? static_->mesh() : placed_[object - 1].object.body->mesh();
}

ShearedRay Scene::shearedFor(const Ray& ray, std::uint32_t object) const
{
  if (object == 0)
  {
    return ShearedRay(ray.origin, ray.direction);
  }
  const Placed& placed = placed_[object - 1];
  return ShearedRay(placed.toObject(ray.origin), placed.inverse * ray.direction);
}

Triangle Scene::worldTriangle(const TriangleId& id) const
{
  const Triangle& triangle = meshOf(id.object)[id.triangle];
  return id.object == 0 ? triangle
                        : transformed(placed_[id.object - 1].object.worldFromObject, triangle);
}

Scene::TopTree Scene::buildTop(
  const std::vector<bool>& chosen, bool withStatic, const Checkpoint& checkpoint) const
{
  TopTree top;
  std::vector<KdPrimitive> primitives;
  std::vector<Triangle> world;
  std::size_t count = withStatic ? static_->mesh().size() : 0;
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    count += chosen[i] ? placed_[i].object.body->mesh().size() : 0;
  }
  world.reserve(count); // primitives point into it
  if (withStatic)
  {
    addEntries(0, true, top, primitives, world);
  }
  for (std::uint32_t i = 0; i < chosen.size(); ++i)
  {
    if (chosen[i] && !placed_[i].object.body->mesh().isEmpty())
    {
      addEntries(i + 1, withStatic || placed_[i].object.isLoose, top, primitives, world);
    }
  }
  KdTreeBuilder builder;
  builder.checkpoint = checkpoint;
  top.tree = builder.build(primitives);
  return top;
}

void Scene::addEntries(std::uint32_t object, bool asTriangles, TopTree& top,
  std::vector<KdPrimitive>& primitives, std::vector<Triangle>& world) const
{
  if (!asTriangles)
  {
    top.entries.push_back({ object, Entry::kWhole });
    primitives.push_back({ placed_[object - 1].bound.worldBox() });
    return;
  }
  const double margin = object == 0 ? 0.0 : placed_[object - 1].roundTrip;
  for (std::uint32_t i = 0; i < meshOf(object).size(); ++i)
  {
    world.push_back(worldTriangle({ object, i }));
    Box bounds = world.back().bounds();
    bounds.inflate(margin);
    top.entries.push_back({ object, i });
    primitives.push_back({ bounds, &world.back(), margin });
  }
}

Hit Scene::castTop(const TopTree& top, const Ray& ray, Hit best) const
{
  KdTraversal traversal(top.tree, ray.origin, ray.direction);
  if (traversal.isFinished())
  {
    return best;
  }
  TopCast cast(*this, top, ray);
  while (traversal.advance(traversal.limit(best.distance)))
  {
    cast.testLeaf(traversal, best);
  }
  return best;
}

Hit Scene::castStatic(const Ray& ray, Hit best, double from) const
{
  castMesh(*static_, ray.origin, ray.direction, 0, ray.start, best, from);
  return best;
}

Hit Scene::castDynamic(const Ray& ray, Hit best) const
{
  return castTop(dynamicTree_, ray, best);
}

Hit Scene::castMoved(const Ray& ray, Hit best) const
{
  return castTop(movedTree_, ray, best);
}

bool Scene::movedMayTouch(const Vector3& origin, const Vector3& direction, double distance) const
{
  constexpr std::size_t kFewerThanTree = 8;
  if (moved_.size() > kFewerThanTree)
  {
    return true; // the tree over the moved objects rejects faster than one test for each
  }
  const double length = lookAhead(distance, reach_);
  for (const Moved& moved : moved_)
  {
    const Vector3 toCenter = moved.center - origin;
    const double nearest = std::min(std::max(toCenter.dot(direction), 0.0), length);
    const bool missesBall = (toCenter - nearest * direction).squaredNorm() > moved.squaredRadius;
    if (!missesBall && !placed_[moved.index].bound.rejects(origin, origin + length * direction))
    {
      return true;
    }
  }
  return false;
}

Hit Scene::cast(const Ray& ray) const
{
  if (placed_.empty())
  {
    return castStatic(ray, {});
  }
  switch (mode_)
  {
    case TraversalMode::OneTree:
      return castTop(oneTree_, ray, {});
    case TraversalMode::Sequential:
      return castStatic(ray, castDynamic(ray, {}));
    case TraversalMode::Parallel:
      break;
  }
  return castParallel(ray);
}

/// Section 2.4 of the paper: a stack, a node and a search interval for each tree.
Hit Scene::castParallel(const Ray& ray) const
{
  Hit best;
  KdTraversal still(static_->tree(), ray.origin, ray.direction);
  KdTraversal moving(dynamicTree_.tree, ray.origin, ray.direction);
  if (moving.isFinished())
  {
    return castStatic(ray, best);
  }
  const ShearedRay sheared(ray.origin, ray.direction);
  TopCast cast(*this, dynamicTree_, ray);
  while (!still.isFinished() || !moving.isFinished())
  {
    if (still.nextEntry() <= moving.nextEntry())
    {
      if (still.advance(still.limit(best.distance)))
      {
        testLeaf(still, static_->mesh(), sheared, 0, ray.start, best);
      }
    }
    else if (moving.advance(moving.limit(best.distance)))
    {
      cast.testLeaf(moving, best);
    }
  }
  return best;
}

SurfacePoint Scene::surfaceAt(const Ray& ray, const Hit& hit) const
{
  double distance;
  Vector3 weights;
  const Triangle& triangle = meshOf(hit.id.object)[hit.id.triangle];
  shearedFor(ray, hit.id.object).meets(triangle, distance, &weights);
  SurfacePoint point = surfacePoint(worldTriangle(hit.id), weights);
  point.isFront = ray.direction.dot(point.normal) <= 0;
  if (!point.isFront)
  {
    point.normal = -point.normal;
  }
  return point;
}

}
