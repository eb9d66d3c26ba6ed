// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/CoincidentTriangles.h"

#include "Trees/LeafQuery.h"

#include <algorithm>

namespace irradiance
{

std::array<const Vector3*, 3> cornersOf(const Triangle& triangle)
{
  return { &triangle.a, &triangle.b, &triangle.c };
}

std::array<Vector3, 3> inwardOf(const Triangle& t)
{
  const Vector3 normal = t.areaVector().normalized();
  return { normal.cross((t.b - t.a).normalized()), normal.cross((t.c - t.b).normalized()),
    normal.cross((t.a - t.c).normalized()) };
}

Box touchedBox(Box box)
{
  box.inflate(2 * kTouching * box.magnitude());
  return box;
}

Triangle worldTriangle(const SceneObject& object, std::uint32_t triangle)
{
  return transformed(object.worldFromObject, object.body->mesh()[triangle]);
}

Triangle worldTriangle(const SceneObjects& objects, const TriangleId& id)
{
  return worldTriangle(objects[id.object], id.triangle);
}

std::vector<std::uint32_t> trianglesNear(const SceneObject& object, const Box& world)
{
  if (object.isEmpty())
  {
    return {};
  }
  const Matrix3 inverse = object.worldFromObject.linear.inverse();
  const Vector3 center = inverse * (world.center() - object.worldFromObject.translation);
  // The second term is for rounding, here and in the poses.
  const Vector3 reach =
    inverse.cwiseAbs() * (0.5 * world.extent() + Vector3::Constant(kTouching * world.magnitude()));
  return trianglesNear(object.body->tree(), Box{ center - reach, center + reach });
}

FlatTriangle::FlatTriangle(const Triangle& triangle)
  : triangle_(triangle)
  , normal_(triangle.areaVector().normalized())
  , inward_(inwardOf(triangle))
  , magnitude_(triangle.bounds().magnitude())
{
}

/// The cheapest test comes first, which nearly all neighbours in a mesh fail.
bool FlatTriangle::coincidesWith(const Triangle& other) const
{
  const double tolerance = kTouching * std::max(magnitude_, other.bounds().magnitude());
  if (isSeparatedFrom(other, tolerance))
  {
    return false;
  }
  const bool holdsOther = FlatTriangle::isInPlaneOf(other, tolerance);
  const FlatTriangle flat(other);
  return (holdsOther || flat.isInPlaneOf(triangle_, tolerance)) &&
    !flat.isSeparatedFrom(triangle_, tolerance);
}

/// Whether a line along an edge separates the two, as seen along the normal.
bool FlatTriangle::isSeparatedFrom(const Triangle& other, double tolerance) const
{
  const auto corners = cornersOf(triangle_);
  bool isSeparated = false;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto in = [&](const Vector3& point) { return inward_[i].dot(point - *corners[i]); };
    isSeparated =
      isSeparated || std::max({ in(other.a), in(other.b), in(other.c) }) <= 4 * tolerance;
  }
  return isSeparated;
}

/// Whether the other triangle lies in the plane of this one.
bool FlatTriangle::isInPlaneOf(const Triangle& other, double tolerance) const
{
  const auto height = [&](const Vector3& point) {
    return std::abs(normal_.dot(point - triangle_.a));
  };
  return height(other.a) <= tolerance && height(other.b) <= tolerance &&
    height(other.c) <= tolerance;
}

namespace
{

void sortOut(std::vector<TrianglePair>& pairs)
{
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Those of the triangles [first, end).
void addPairs(
  const RigidObject& body, std::size_t first, std::size_t end, std::vector<TrianglePair>& pairs)
{
  const TriangleMesh& mesh = body.mesh();
  for (auto i = static_cast<std::uint32_t>(first); i < end; ++i)
  {
    const FlatTriangle flat(mesh[i]);
    body.forEachTree([&](const TriangleTree& tree) {
      forEachNear(tree, touchedBox(mesh[i].bounds()), [&](std::uint32_t k) {
        if (k > i && flat.coincidesWith(mesh[k]))
        {
          pairs.emplace_back(i, k);
        }
      });
    });
  }
  sortOut(pairs);
}

}

std::vector<std::vector<TrianglePair>> coincidentWithin(
  const std::vector<const RigidObject*>& bodies, Execution& execution)
{
  constexpr std::size_t kTogether = 1024;
  struct Unit
  {
    std::size_t body, first;
    std::vector<TrianglePair> pairs;
  };
  std::vector<Unit> units;
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    for (std::size_t first = 0; first < bodies[i]->mesh().size(); first += kTogether)
    {
      units.push_back({ i, first, {} });
    }
  }
  forEachSliced(units.size(), execution, [&](std::size_t number) {
    Unit& unit = units[number];
    const RigidObject& body = *bodies[unit.body];
    addPairs(body, unit.first, std::min(unit.first + kTogether, body.mesh().size()), unit.pairs);
  });
  std::vector<std::vector<TrianglePair>> pairs(bodies.size());
  for (const Unit& unit : units)
  {
    pairs[unit.body].insert(pairs[unit.body].end(), unit.pairs.begin(), unit.pairs.end());
  }
  return pairs;
}

std::vector<TrianglePair> coincidentBetween(
  const SceneObject& first, const SceneObject& second, const CancelPoint& cancelPoint)
{
  const Box common = touchedBox(first.worldBounds()).intersection(touchedBox(second.worldBounds()));
  std::vector<TrianglePair> pairs;
  if (common.isEmpty())
  {
    return pairs;
  }
  std::vector<std::uint32_t> some = trianglesNear(first, common);
  const bool isFirst = some.size() <= second.body->mesh().size();
  const SceneObject &from = isFirst ? first : second, &to = isFirst ? second : first;
  some = isFirst ? some : trianglesNear(second, common);
  ThrottledCancelPoint pace(cancelPoint);
  for (const std::uint32_t i : some)
  {
    pace.step(16);
    const Triangle triangle = worldTriangle(from, i);
    const FlatTriangle flat(triangle);
    for (const std::uint32_t k :
      trianglesNear(to, touchedBox(triangle.bounds()).intersection(common)))
    {
      if (flat.coincidesWith(worldTriangle(to, k)))
      {
        pairs.push_back(isFirst ? TrianglePair(i, k) : TrianglePair(k, i));
      }
    }
  }
  sortOut(pairs);
  return pairs;
}

}
