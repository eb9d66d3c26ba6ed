// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "Kernels/IntersectionLanes.h"
#include "Scene/QueryBatch.h"
#include "Scene/RayOrder.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

/// The error of a world position taken to model space and back: a few ulps times the condition of
/// the map. 2^-44 leaves room for sums of a few hundred such errors.
double roundTripError(const AffineMap& map, double condition, double magnitude)
{
  return 0x1p-44 * condition * (magnitude + map.translation.cwiseAbs().maxCoeff());
}

/// Fewer instanced objects than this are tried one after the other.
constexpr std::size_t kManyObjects = 4;

/// The ball around the ellipsoid or the ball around its box, whichever is smaller.
Ball ballAround(const EllipsoidBound& bound)
{
  const Box& box = bound.worldBox();
  if (box.isEmpty())
  {
    return { Vector3::Zero(), 0 };
  }
  // Pays for all rounding, which is far below the widening of the bound.
  constexpr double kWider = 1 + 0x1p-20;
  Ball aroundBox{ box.center(), 0.25 * box.extent().squaredNorm() * kWider };
  const EllipsoidBound::Ball round = bound.ball();
  constexpr double kVanished = 0x1p-10; // about 1 unless numbers are too small to be squared
  if (round.radius < kVanished)
  {
    return aroundBox;
  }
  const Vector3 stretches = Eigen::JacobiSVD<Matrix3>(round.roundFromWorld).singularValues();
  const double longest = round.radius / stretches[2];
  const Ball aroundEllipsoid{ round.center, longest * longest * kWider };
  return aroundEllipsoid.squaredRadius < aroundBox.squaredRadius ? aroundEllipsoid : aroundBox;
}

double conditionOf(const Matrix3& linear, const Matrix3& inverse)
{
  return std::max(1.0, (linear.cwiseAbs() * inverse.cwiseAbs()).rowwise().sum().maxCoeff());
}

}

Scene::Scene()
  : static_(std::make_shared<RigidObject>(TriangleMesh()))
{
}

void Scene::setStatic(std::shared_ptr<const RigidObject> body)
{
  static_ = std::move(body);
}

void Scene::setDynamic(const std::vector<PlacedBody>& objects)
{
  objects_ = objects;
}

void Scene::commit(const std::vector<bool>& moved, const CancelPoint& cancelPoint)
{
  bounds_ = static_->mesh().bounds();
  treeBytes_ = static_->tree().bytes();
  for (const PlacedBody& object : objects_)
  {
    treeBytes_ += object.isPresent ? object.body->tree().bytes() : 0;
    bounds_.add(object.worldBounds());
  }
  place(std::max(bounds_.magnitude(), pointSources_.magnitude()));
  dynamic_ = {};
  dynamic_ = group(std::vector<bool>(objects_.size(), true), cancelPoint);
  moved_ = moved.empty() ? Group{} : group(moved, cancelPoint);
  oneTree_ = {};
  if (mode_ == TraversalMode::OneTree && !objects_.empty())
  {
    std::vector<std::uint32_t> all(objects_.size() + 1);
    std::iota(all.begin(), all.end(), 0u);
    oneTree_ = mix(all, cancelPoint);
  }
}

void Scene::place(double magnitude)
{
  placed_.clear();
  for (const PlacedBody& object : objects_)
  {
    const Matrix3& linear = object.worldFromObject.linear;
    const Matrix3 inverse = linear.inverse();
    const double condition = conditionOf(linear, inverse);
    const double error = roundTripError(object.worldFromObject, condition, magnitude);
    const TriangleTree& tree = object.body->tree();
    const double slack = tree.slack() / tree.frame().scale * linear.norm() * condition;
    const EllipsoidBound bound(
      object.body->ellipsoid(), object.body->mesh().bounds(), object.worldFromObject, error);
    placed_.push_back({ object, inverse, condition, error, slack, bound, ballAround(bound) });
  }
}

Scene::MixedTree Scene::mix(
  const std::vector<std::uint32_t>& objects, const CancelPoint& cancelPoint) const
{
  MixedTree mixed;
  mixed.objects = objects;
  std::vector<Triangle> world;
  std::vector<double> blurs;
  double conditionNumber = 1;
  mixed.first.resize(placed_.size() + 1, TriangleId::kNone);
  for (const std::uint32_t object : objects)
  {
    mixed.first[object] = static_cast<std::uint32_t>(world.size());
    conditionNumber = std::max(conditionNumber, object == 0 ? 1.0 : placed_[object - 1].condition);
    for (std::uint32_t i = 0; i < meshOf(object).size(); ++i)
    {
      mixed.ids.push_back({ object, i });
      world.push_back(worldTriangle(mixed.ids.back()));
      blurs.push_back(object == 0 ? 0.0 : placed_[object - 1].roundTrip);
    }
  }
  mixed.tree = TriangleTree(world, blurs, conditionNumber, cancelPoint);
  return mixed;
}

Scene::Group Scene::group(const std::vector<bool>& chosen, const CancelPoint& cancelPoint) const
{
  Group group;
  std::vector<std::uint32_t> flattened;
  std::vector<Box> boxes;
  double slack = 0;
  for (std::uint32_t i = 0; i < chosen.size(); ++i)
  {
    if (!chosen[i] || placed_[i].object.isEmpty())
    {
      continue;
    }
    if (placed_[i].object.isFlattened)
    {
      flattened.push_back(i + 1);
    }
    else
    {
      group.instanced.push_back(i);
      boxes.push_back(placed_[i].bound.worldBox());
      slack = std::max(slack, placed_[i].slack);
    }
  }
  if (dynamic_.flattened && dynamic_.flattened->objects == flattened)
  {
    group.flattened = dynamic_.flattened;
  }
  else if (!flattened.empty())
  {
    group.flattened = std::make_shared<MixedTree>(mix(flattened, cancelPoint));
  }
  if (boxes.size() >= kManyObjects)
  {
    group.bodies = TriangleTree(boxes, slack, cancelPoint);
  }
  return group;
}

bool Scene::intersects(
  const Ray& ray, const TriangleId& id, double& distance, Vector3* weights) const
{
  const LocalRay local = localRay(ray, id.object);
  return ShearedRay(local.origin, local.direction).intersects(localTriangle(id), distance, weights);
}

Hit Scene::hitOf(const Ray& ray, const TriangleId& id) const
{
  double distance;
  Vector3 weights;
  return intersects(ray, id, distance, &weights)
    ? Hit{ distance, id, { static_cast<float>(weights[1]), static_cast<float>(weights[2]) } }
    : Hit{};
}

Triangle Scene::worldTriangle(const TriangleId& id) const
{
  const Triangle& triangle = localTriangle(id);
  return id.object == 0 ? triangle
                        : transformed(placed_[id.object - 1].object.worldFromObject, triangle);
}

double Scene::reachOf(const Ray& ray) const
{
  return 2 *
    std::max((bounds_.lower - ray.origin).cwiseAbs().maxCoeff(),
      (bounds_.upper - ray.origin).cwiseAbs().maxCoeff()) /
    ray.direction.cwiseAbs().maxCoeff();
}

bool Scene::mayTouch(const Placed& placed, const Ray& ray, double distance) const
{
  const double squaredLength = ray.direction.squaredNorm();
  const double end =
    distance < kInfinity ? distance + placed.slack / std::sqrt(squaredLength) : reachOf(ray);
  const Vector3 toCenter = placed.ball.center - ray.origin;
  const double nearest = std::min(std::max(toCenter.dot(ray.direction) / squaredLength, 0.0), end);
  if ((toCenter - nearest * ray.direction).squaredNorm() > placed.ball.squaredRadius)
  {
    return false;
  }
  return !placed.bound.rejects(ray.origin, ray.origin + end * ray.direction);
}

std::vector<std::uint32_t> Scene::orderOf(const Ray* rays, std::size_t count) const
{
  // Trees larger than the processor's cache, and enough rays that some are near each other.
  constexpr std::size_t kLargeTrees = 1u << 22, kManyRays = 1u << 15;
  return treeBytes_ > kLargeTrees && count > kManyRays
    ? coherentOrder(rays, static_cast<std::uint32_t>(count), bounds_)
    : std::vector<std::uint32_t>();
}

void Scene::castStatic(const Ray* rays, std::size_t count, Hit* best, const double* from) const
{
  QueryBatch(*this, rays, best, from)
    .runAllStatic(static_cast<std::uint32_t>(count), orderOf(rays, count));
}

void Scene::castDynamic(const Ray* rays, std::size_t count, Hit* best) const
{
  castGroup(dynamic_, rays, count, best);
}

void Scene::castMoved(const Ray* rays, std::size_t count, Hit* best) const
{
  castGroup(moved_, rays, count, best);
}

void Scene::castGroup(const Group& group, const Ray* rays, std::size_t count, Hit* best) const
{
  const std::vector<std::uint32_t> order = orderOf(rays, count);
  QueryBatch batch(*this, rays, best);
  const bool isAllBehindBodies = !group.flattened && !group.bodies.isEmpty();
  const auto end = static_cast<std::uint32_t>(isAllBehindBodies ? 0 : count);
  for (std::uint32_t first = 0; first < end; first += BallLanes::kSize)
  {
    batch.addGroup(group, first, std::min(first + BallLanes::kSize, end), order, nullptr);
    batch.runIfMany();
  }
  batch.run();
  if (!group.bodies.isEmpty())
  {
    batch.runAllBodies(group, static_cast<std::uint32_t>(count), order);
  }
}

void Scene::cast(const Ray* rays, std::size_t count, Hit* hits) const
{
  std::fill_n(hits, count, Hit{});
  if (placed_.empty())
  {
    return castStatic(rays, count, hits);
  }
  if (mode_ == TraversalMode::Sequential)
  {
    castDynamic(rays, count, hits);
    return castStatic(rays, count, hits);
  }
  if (mode_ == TraversalMode::Parallel && !dynamic_.bodies.isEmpty())
  {
    // Once a static hit is known, few of many bodies are before it and have to be searched.
    castStatic(rays, count, hits);
    return castDynamic(rays, count, hits);
  }
  const std::vector<std::uint32_t> order = orderOf(rays, count);
  QueryBatch batch(*this, rays, hits);
  std::vector<std::uint32_t> alone; // rays that touch nothing dynamic
  const auto end = static_cast<std::uint32_t>(count);
  for (std::uint32_t first = 0; first < end; first += BallLanes::kSize)
  {
    const std::uint32_t next = std::min(first + BallLanes::kSize, end);
    mode_ == TraversalMode::OneTree ? batch.add(oneTree_, first, next, order)
                                    : batch.addGroup(dynamic_, first, next, order, &alone);
    batch.runIfMany();
  }
  batch.run();
  if (!alone.empty())
  {
    QueryBatch(*this, rays, hits).runAllStatic(static_cast<std::uint32_t>(alone.size()), alone);
  }
}

SurfacePoint Scene::surfaceAt(const Vector3& direction, const Hit& hit) const
{
  SurfacePoint point = surfaceOf(hit, true);
  point.turn(direction.dot(point.normal) <= 0);
  return point;
}

SurfacePoint Scene::surfaceOf(const Hit& hit, bool isFront) const
{
  SurfacePoint point = surfacePoint(worldTriangle(hit.id), weightsOf(hit));
  point.turn(isFront);
  return point;
}

/// A map makes triangles slenderer by at most its condition squared: edges grow by at most the
/// largest singular value, areas shrink by at most the product of the two smallest.
double Scene::clearance() const
{
  double farthest = static_->mesh().clearance();
  for (const Placed& placed : placed_)
  {
    if (placed.object.isEmpty())
    {
      continue;
    }
    const TriangleMesh& mesh = placed.object.body->mesh();
    const Matrix3& linear = placed.object.worldFromObject.linear;
    const Matrix3 square = linear.transpose() * linear;
    const double mean = square.trace() / 3;
    const bool isSimilarity = (square - mean * Matrix3::Identity()).norm() < 0.125 * mean;
    const double condition = isSimilarity ? 1.25 : linear.norm() * placed.inverse.norm();
    // Only its own coordinates count: an object far away does not make this one less exact.
    const double magnitude = placed.object.worldBounds().magnitude() * (1 + 0x1p-20);
    farthest = std::max(farthest,
      farthestClearance(
        magnitude, linear.norm() * mesh.longestEdge(), condition * condition * mesh.slenderness()));
  }
  return farthest;
}

EllipsoidBound Scene::shadowBound(std::uint32_t index, double blur) const
{
  const PlacedBody& object = placed_[index].object;
  return EllipsoidBound(object.body->ellipsoid(), object.body->mesh().bounds(),
    object.worldFromObject, shadowPad(index, blur));
}

}
