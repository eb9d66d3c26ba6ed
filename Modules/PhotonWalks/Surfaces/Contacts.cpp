// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Contacts.h"

#include "Geometry/MovedBox.h"
#include "Surfaces/Touching.h"
#include "Trees/BoxQuery.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace irradiance
{

namespace
{

double toleranceOf(const Triangle& s, const Triangle& t)
{
  return kTouching * std::max(s.bounds().magnitude(), t.bounds().magnitude());
}

bool isInPlaneOf(const Triangle& s, const Triangle& t, double tolerance)
{
  const Vector3 normal = s.areaVector().normalized();
  return std::abs(normal.dot(t.a - s.a)) <= tolerance &&
    std::abs(normal.dot(t.b - s.a)) <= tolerance && std::abs(normal.dot(t.c - s.a)) <= tolerance;
}

/// Whether a line along an edge of `s` separates the two triangles, which lie in one plane.
bool isSeparatedByEdge(const Triangle& s, const Triangle& t, double tolerance)
{
  const auto corners = cornersOf(s);
  const auto inward = inwardOf(s);
  bool isSeparated = false;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto in = [&](const Vector3& point) { return inward[i].dot(point - *corners[i]); };
    isSeparated = isSeparated || std::max({ in(t.a), in(t.b), in(t.c) }) <= 4 * tolerance;
  }
  return isSeparated;
}

bool doCoincide(const Triangle& s, const Triangle& t)
{
  const double tolerance = toleranceOf(s, t);
  return (isInPlaneOf(s, t, tolerance) || isInPlaneOf(t, s, tolerance)) &&
    !isSeparatedByEdge(s, t, tolerance) && !isSeparatedByEdge(t, s, tolerance);
}

/// World bounds, slightly inflated, of a box in the space of the object.
Box worldBounds(const SceneObject& object, const Box& model)
{
  return touchedBox(movedBox(object.worldFromObject, model));
}

Box worldBounds(const SceneObject& object)
{
  return worldBounds(object, object.body->mesh().bounds());
}

bool holds(const Box& outer, const Box& inner)
{
  return !inner.isEmpty() && (inner.lower.array() >= outer.lower.array()).all() &&
    (inner.upper.array() <= outer.upper.array()).all();
}

}

void Contacts::update(
  const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint)
{
  const Search search{ objects, sides, cancelPoint };
  contacts_.clear();
  isTouched_.assign(objects.size(), {});
  known_.resize(objects.size());
  for (std::uint32_t lamp = 0; lamp < objects.size(); ++lamp)
  {
    if (!objects[lamp].emits() || objects[lamp].emission->exitance.empty() ||
      objects[lamp].isEmpty())
    {
      continue;
    }
    addOwn(search, lamp);
    for (std::uint32_t other = 0; other < objects.size(); ++other)
    {
      if (other != lamp)
      {
        addBetween(search, lamp, other);
      }
    }
  }
  const auto order = [](const ContactTriangle& a, const ContactTriangle& b) {
    return key(a.id) < key(b.id);
  };
  const auto isSame = [](const ContactTriangle& a, const ContactTriangle& b) {
    return a.id == b.id;
  };
  for (auto& entry : contacts_)
  {
    std::vector<ContactTriangle>& partners = entry.second.partners;
    std::sort(partners.begin(), partners.end(), order);
    partners.erase(std::unique(partners.begin(), partners.end(), isSame), partners.end());
    const auto& [object, triangle] = entry.first;
    isTouched_[object].resize(objects[object].body->mesh().size());
    isTouched_[object][triangle] = 1;
  }
}

void Contacts::addOwn(const Search& search, std::uint32_t object)
{
  ObjectContacts& known = known_[object];
  const SceneObject& own = search.objects[object];
  if (!known.hasPairs || !isSameThing(own, known.object))
  {
    known = { own, {}, {}, false };
    const TriangleMesh& mesh = own.body->mesh();
    ThrottledCancelPoint pace(search.cancelPoint);
    for (std::uint32_t i = 0; i < mesh.size(); ++i)
    {
      pace.step(16);
      if (!own.isLamp(i))
      {
        continue;
      }
      const Box box = mesh[i].bounds();
      known.lamps.add(box);
      for (const std::uint32_t k : irradiance::trianglesNear(own.body->tree(), touchedBox(box)))
      {
        if (k != i && doCoincide(mesh[i], mesh[k]))
        {
          known.pairs.emplace_back(i, k);
        }
      }
    }
    known.hasPairs = true;
  }
  for (const auto& [i, k] : known.pairs)
  {
    add(search, { object, i }, { object, k });
  }
}

void Contacts::addBetween(const Search& search, std::uint32_t lamp, std::uint32_t other)
{
  const SceneObjects& objects = search.objects;
  const Box common =
    worldBounds(objects[lamp], known_[lamp].lamps).intersection(worldBounds(objects[other]));
  if (common.isEmpty())
  {
    return;
  }
  ThrottledCancelPoint pace(search.cancelPoint);
  for (const std::uint32_t i : trianglesNear(objects[lamp], common))
  {
    pace.step(16);
    if (!objects[lamp].isLamp(i))
    {
      continue;
    }
    const Triangle triangle = worldTriangle(objects, { lamp, i });
    const Box box = touchedBox(triangle.bounds()).intersection(common);
    for (const std::uint32_t k : trianglesNear(objects[other], box))
    {
      if (doCoincide(triangle, worldTriangle(objects, { other, k })))
      {
        add(search, { lamp, i }, { other, k });
      }
    }
  }
}

void Contacts::add(const Search& search, const TriangleId& a, const TriangleId& b)
{
  for (const auto& [self, other] : { std::pair(a, b), std::pair(b, a) })
  {
    Contact& touched = contacts_[key(self)];
    touched.self = contactTriangleOf(search, self);
    touched.partners.push_back(contactTriangleOf(search, other));
  }
}

Contacts::ContactTriangle Contacts::contactTriangleOf(const Search& search, const TriangleId& id)
{
  const SceneObject& object = search.objects[id.object];
  const SolidSides& sides = search.sides.of(search.objects, id.object, search.cancelPoint);
  SolidSide side = sides.of[id.triangle];
  // A dynamic shell that encloses all static geometry, with its front inside, lines a room.
  if (id.object > 0 && side == SolidSide::InFront && sides.shell(id.triangle).isOutermost &&
    holds(worldBounds(object), search.objects.staticObject.body->mesh().bounds()))
  {
    side = SolidSide::Behind;
  }
  return { id, side, object.isLamp(id.triangle) };
}

bool Contacts::hasDynamic(const TriangleId& id) const
{
  return has(id) && (id.object > 0 || contacts_.at(key(id)).partners.back().id.object > 0);
}

namespace
{

/// +1 if the direction leads into the solid of a triangle with this normal, -1 if out of it, 0 for
/// sheets.
int intoSolid(SolidSide side, const Vector3& normal, const Vector3& direction)
{
  const int along = normal.dot(direction) > 0 ? 1 : -1;
  return side == SolidSide::None ? 0 : side == SolidSide::InFront ? along : -along;
}

}

/// Whether the other triangle stops a ray that leaves the start: the ray enters its solid and not
/// the start's; or it comes out of the start's solid, and the other is a sheet, which lies outside.
bool Contacts::blocks(const Scene& scene, const Vector3& leaving, const ContactTriangle& start,
  const ContactTriangle& other)
{
  const int fromStart = intoSolid(start.side, scene.worldTriangle(start.id).areaVector(), leaving);
  const int toOther = intoSolid(other.side, scene.worldTriangle(other.id).areaVector(), leaving);
  return toOther > 0 ? fromStart <= 0 : toOther == 0 && fromStart < 0;
}

/// The order in which a ray hits coincident triangles: those out of whose solid it comes, lamps
/// that face it, other sheets, lamps that face away, those into whose solid it goes.
int Contacts::rank(const Scene& scene, const Vector3& direction, const ContactTriangle& partner)
{
  const Vector3 normal = scene.worldTriangle(partner.id).areaVector();
  switch (intoSolid(partner.side, normal, direction))
  {
    case -1:
      return 0;
    case 1:
      return 4;
    default:
      return !partner.isLamp ? 2 : normal.dot(direction) < 0 ? 1 : 3;
  }
}

Hit Contacts::resolveContact(const Scene& scene, const Ray& ray, const Hit& closest) const
{
  const Hit touching = has(ray.start) ? hitAtStart(scene, ray) : Hit{};
  return touching ? touching : has(closest.id) ? firstOf(scene, ray, closest) : closest;
}

/// The hit on the triangle that stops a ray at its start; none if the ray can leave.
Hit Contacts::hitAtStart(const Scene& scene, const Ray& ray) const
{
  const Contact& start = contacts_.at(key(ray.start));
  const Triangle triangle = scene.worldTriangle(ray.start);
  const Vector3 normal = triangle.areaVector().normalized();
  const Vector3 leaving = normal.dot(ray.direction) > 0 ? normal : Vector3(-normal);
  const double step = 8 * kTouching * triangle.bounds().magnitude();
  const Ray back{ ray.origin + step * leaving, -leaving, ray.start };
  for (const ContactTriangle& partner : start.partners)
  {
    if (blocks(scene, leaving, start.self, partner))
    {
      if (Hit hit = scene.hitOf(back, partner.id))
      {
        hit.distance = 0;
        return hit;
      }
    }
  }
  return {};
}

/// Of the closest triangle and those that coincide with it, the one that the ray hits first.
Hit Contacts::firstOf(const Scene& scene, const Ray& ray, const Hit& closest) const
{
  const Contact& touched = contacts_.at(key(closest.id));
  Hit first = closest;
  int firstRank = rank(scene, ray.direction, touched.self);
  for (const ContactTriangle& partner : touched.partners)
  {
    const int partnerRank = rank(scene, ray.direction, partner);
    const bool isBefore =
      std::make_tuple(partnerRank, key(partner.id)) < std::make_tuple(firstRank, key(first.id));
    if (isBefore && partner.id != ray.start)
    {
      if (const Hit hit = scene.hitOf(ray, partner.id))
      {
        first = hit;
        firstRank = partnerRank;
      }
    }
  }
  return first;
}

}
