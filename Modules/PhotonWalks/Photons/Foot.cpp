// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/Foot.h"

#include "Meshes/TriangleInSphere.h"
#include "Surfaces/Contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace irradiance
{

void Surfaces::update(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  forgetOthers(objects);
  known_.resize(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject& object = objects[i];
    if (!known_[i].body)
    {
      known_[i].tree = { object.body->mesh(), solidSidesInModel(object, i == 0, cancelPoint),
        cancelPoint };
      known_[i].body = object.body;
      known_[i].material = object.material;
    }
  }
}

void Surfaces::forgetOthers(const SceneObjects& objects)
{
  known_.resize(std::min<std::size_t>(known_.size(), objects.size()));
  for (std::uint32_t i = 0; i < known_.size(); ++i)
  {
    if (known_[i].body != objects[i].body || known_[i].material != objects[i].material)
    {
      known_[i] = {};
    }
  }
}

namespace
{

/// What is found so far.
struct Found
{
  double squaredDistance = kInfinity;
  TriangleId id;
  int side = 0;

  bool isCloser(const Found& other) const
  {
    return std::make_tuple(squaredDistance, id.object, id.triangle) <
      std::make_tuple(other.squaredDistance, other.id.object, other.id.triangle);
  }
};

class FootSearch
{
public:
  FootSearch(const SceneObjects& objects, const Surfaces& surfaces,
    const std::vector<PlacedTree>& placed, const Sensor& sensor, double maximumDistance)
    : objects_(objects)
    , surfaces_(surfaces)
    , placed_(placed)
    , sensor_(sensor)
    , maximumDistance_(maximumDistance)
  {
  }

  std::optional<Foot> run()
  {
    std::vector<std::pair<double, std::uint32_t>> nearest;
    for (std::uint32_t i = 0; i < objects_.size(); ++i)
    {
      const double distance = placed_[i].distanceAtLeast(sensor_.position);
      if (!objects_[i].isEmpty() && !surfaces_.of(i).isEmpty() && distance <= maximumDistance_)
      {
        nearest.emplace_back(distance, i);
      }
    }
    std::sort(nearest.begin(), nearest.end());
    for (const auto& [distance, object] : nearest)
    {
      if (distance <= limit())
      {
        search(
          object, 0, placed_[object].facing(sensor_), placed_[object].unitPoint(sensor_.position));
      }
    }
    const bool isOutside =
      outside_.side != 0 && outside_.squaredDistance <= 4 * inside_.squaredDistance;
    const Found& found = isOutside ? outside_ : inside_;
    return found.side == 0 ? std::nullopt : std::optional<Foot>(on(found.id, found.side));
  }

private:
  /// From the sensor to the closest point of a triangle, world. Seen from the sensor, as corners
  /// far from the origin are rounded more.
  Vector3 closestOn(const TriangleId& id) const
  {
    const SceneObject& object = objects_[id.object];
    const AffineMap fromSensor{ object.worldFromObject.linear,
      object.worldFromObject.translation - sensor_.position };
    return closestPoint(transformed(fromSensor, object.body->mesh()[id.triangle]));
  }

  /// On a side of a triangle.
  Foot on(const TriangleId& id, int side) const
  {
    const PlacedTree& placed = placed_[id.object];
    const Vector3 closest = closestOn(id);
    const Vector3 front =
      placed.facing(sensor_).areaVector(objects_[id.object].body->mesh()[id.triangle]).normalized();
    return { { sensor_.position + closest, sensor_.normal }, Vector3(side * front),
      isInside(surfaces_.of(id.object).solidSide(id.triangle), side, placed.isMirrored()),
      closest.norm(), placed.size(), id, side > 0 };
  }

  /// Surface farther away is not searched.
  double limit() const
  {
    return std::min({ maximumDistance_, std::sqrt(outside_.squaredDistance),
      2 * std::sqrt(inside_.squaredDistance) });
  }

  void search(std::uint32_t object, std::size_t number, const Facing& facing, const Vector3& unit)
  {
    const SurfaceTree& tree = surfaces_.of(object);
    const SurfaceNode& node = tree.node(number);
    if (node.isLeaf())
    {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
      {
        test(object, tree.order()[i], facing);
      }
      return;
    }
    const PlacedTree& placed = placed_[object];
    std::array<std::pair<double, std::size_t>, 2> children;
    children[0].second = number + 1;
    children[1].second = node.right;
    for (auto& [distance, child] : children)
    {
      distance = placed.mayFace(tree.node(child), sensor_.normal)
        ? placed.distanceAtLeast(tree.node(child), unit)
        : kInfinity;
    }
    std::sort(children.begin(), children.end());
    for (const auto& [distance, child] : children)
    {
      if (distance < kInfinity && distance <= limit())
      {
        search(object, child, facing, unit);
      }
    }
  }

  void test(std::uint32_t object, std::uint32_t triangle, const Facing& facing)
  {
    const int side = facing.side(objects_[object].body->mesh()[triangle]);
    if (side != 0)
    {
      const Found found{ closestOn({ object, triangle }).squaredNorm(), { object, triangle },
        side };
      Found& nearest =
        isInside(surfaces_.of(object).solidSide(triangle), side, placed_[object].isMirrored())
        ? inside_
        : outside_;
      if (found.squaredDistance <= maximumDistance_ * maximumDistance_ && found.isCloser(nearest))
      {
        nearest = found;
      }
    }
  }

  const SceneObjects& objects_;
  const Surfaces& surfaces_;
  const std::vector<PlacedTree>& placed_;
  const Sensor& sensor_;
  double maximumDistance_;
  Found inside_, outside_;
};

}

std::optional<Foot> findFoot(const SceneObjects& objects, const Surfaces& surfaces,
  const std::vector<PlacedTree>& placed, const Sensor& sensor, double maximumDistance)
{
  return FootSearch(objects, surfaces, placed, sensor, maximumDistance).run();
}

}
