// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "Scene/FrontCast.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace irradiance
{

namespace
{

/// Up to so many bodies it is faster to test all their balls than to descend a tree.
constexpr std::size_t kManyBodies = 512;

/// Documentation/Theory.md, section 3, derives the constants.
EllipsoidFilter filterOf(const EllipsoidBound& bound)
{
  const EllipsoidBound::Ball ball = bound.ball();
  const double largest = ball.roundFromWorld.cwiseAbs().maxCoeff();
  const double scale = largest > 0 && std::isfinite(largest) ? std::exp2(std::ilogb(largest)) : 1;
  const Matrix3 map = ball.roundFromWorld / scale;
  const double condition = map.norm() * map.inverse().norm(); // not finite if nothing is rejected
  const double squared = ball.radius * ball.radius;
  EllipsoidFilter filter;
  filter.scale = scale;
  Eigen::Map<Vector3>{ filter.center } = ball.center;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>{ filter.roundFromScaled } =
    map.cast<float>();
  filter.squaredRadius =
    static_cast<float>(squared * (1 + 0x1p-6 + 0x1p-34 * condition * condition));
  filter.byDistance = static_cast<float>(0x1p-32 * map.squaredNorm());
  return filter;
}

}

/// The ball around the ellipsoid or the ball around its box, whichever is smaller.
Scene::Ball Scene::ballAround(const EllipsoidBound& bound)
{
  const Box& box = bound.worldBox();
  if (box.isEmpty())
  {
    return { Vector3::Zero(), 0, true };
  }
  // Pays for all rounding, which is far below the widening of the bound.
  constexpr double kWider = 1 + 0x1p-20;
  Ball aroundBox{ box.center(), 0.25 * box.extent().squaredNorm() * kWider, false };
  const EllipsoidBound::Ball round = bound.ball();
  constexpr double kVanished = 0x1p-10; // about 1 unless numbers are too small to be squared
  if (round.radius < kVanished)
  {
    return aroundBox;
  }
  const Vector3 stretches = Eigen::JacobiSVD<Matrix3>(round.roundFromWorld).singularValues();
  const double longest = round.radius / stretches[2];
  constexpr double kTight = 1.25;
  const Ball aroundEllipsoid{ round.center, longest * longest * kWider,
    stretches[0] < kTight * stretches[2] };
  return aroundEllipsoid.squaredRadius < aroundBox.squaredRadius ? aroundEllipsoid : aroundBox;
}

Scene::Scene()
  : static_(std::make_shared<RigidObject>(TriangleMesh()))
{
}

void Scene::commit(const std::vector<bool>& moved, const CancelPoint& cancelPoint)
{
  bounds_ = static_->mesh().bounds();
  std::vector<std::size_t> sizes = { static_->mesh().size() };
  for (const PlacedBody& object : objects_)
  {
    sizes.push_back(object.body->mesh().size());
    bounds_.add(object.worldBounds());
  }
  numbers_ = TriangleNumbers(sizes);
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
    const double condition =
      std::max(1.0, (linear.cwiseAbs() * inverse.cwiseAbs()).rowwise().sum().maxCoeff());
    // A world position taken to model space and back is off by a few ulps times the condition of
    // the map. 2^-44 leaves room for sums of a few hundred such errors.
    const double error =
      0x1p-44 * condition * (magnitude + object.worldFromObject.translation.cwiseAbs().maxCoeff());
    const TriangleTree& tree = object.body->tree();
    const double slack = tree.slack() / tree.frame().scale * linear.norm() * condition;
    const EllipsoidBound bound(
      object.body->ellipsoid(), object.body->mesh().bounds(), object.worldFromObject, error);
    placed_.push_back(
      { object, inverse, condition, error, slack, bound, ballAround(bound), filterOf(bound) });
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
  std::vector<Vector3> centers;
  std::vector<double> squaredRadii;
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
      centers.push_back(placed_[i].ball.center);
      squaredRadii.push_back(placed_[i].ball.squaredRadius);
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
  if (boxes.size() > kManyBodies)
  {
    group.bodies = TriangleTree(boxes, slack, cancelPoint);
  }
  else if (group.isMany())
  {
    group.balls = BodyBalls(centers, squaredRadii);
  }
  return group;
}

Hit Scene::hitOf(const Ray& ray, const TriangleId& id) const
{
  const Ray local = localRay(ray, id.object);
  double distance;
  Vector3 weights;
  return ShearedRay(local.origin, local.direction).intersects(localTriangle(id), distance, &weights)
    ? Hit{ distance, id, { static_cast<float>(weights[1]), static_cast<float>(weights[2]) } }
    : Hit{};
}

Triangle Scene::worldTriangle(const TriangleId& id) const
{
  const Triangle& triangle = localTriangle(id);
  return id.object == 0 ? triangle
                        : transformed(placed_[id.object - 1].object.worldFromObject, triangle);
}

bool Scene::mayTouch(const Placed& placed, const Ray& ray, double distance) const
{
  const double squaredLength = ray.direction.squaredNorm();
  const bool isBounded = distance < kInfinity;
  double end = isBounded ? distance + placed.slack / std::sqrt(squaredLength) : kInfinity;
  const Vector3 toCenter = placed.ball.center - ray.origin;
  const double nearest = std::min(std::max(toCenter.dot(ray.direction) / squaredLength, 0.0), end);
  if ((toCenter - nearest * ray.direction).squaredNorm() > placed.ball.squaredRadius)
  {
    return false;
  }
  if (placed.ball.isTight)
  {
    return true;
  }
  if (!isBounded) // no geometry is farther away
  {
    end = 2 *
      std::max((bounds_.lower - ray.origin).cwiseAbs().maxCoeff(),
        (bounds_.upper - ray.origin).cwiseAbs().maxCoeff()) /
      ray.direction.cwiseAbs().maxCoeff();
  }
  return !placed.bound.rejects(ray.origin, ray.origin + end * ray.direction);
}

void Scene::cast(const Ray* rays, std::size_t count, Hit* hits) const
{
  static thread_local FrontCast cast; // for its memory
  cast.cast(*this, rays, count, hits);
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
