// SPDX-License-Identifier: BSD-3-Clause
#include "Light/Contacts.h"

#include "Geometry/MovedBox.h"
#include "Trees/BoxQuery.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace irradiance
{

namespace
{

/// Triangles nearer than this, of the largest coordinate, coincide. So a point from which a ray
/// leaves one of them, 2^-33 above it, is on the same side of the other as well, or known to touch.
constexpr double kTouching = 0x1p-32;

double toleranceOf(const Triangle& s, const Triangle& t)
{
  return kTouching * std::max(s.bounds().magnitude(), t.bounds().magnitude());
}

std::array<const Vector3*, 3> cornersOf(const Triangle& triangle)
{
  return { &triangle.a, &triangle.b, &triangle.c };
}

bool isInPlaneOf(const Triangle& s, const Triangle& t, double tolerance)
{
  const Vector3 normal = s.areaVector().normalized();
  return std::abs(normal.dot(t.a - s.a)) <= tolerance &&
    std::abs(normal.dot(t.b - s.a)) <= tolerance && std::abs(normal.dot(t.c - s.a)) <= tolerance;
}

/// For each edge the direction in the triangle's plane that points from it to the inside.
std::array<Vector3, 3> inwardOf(const Triangle& t)
{
  const Vector3 normal = t.areaVector().normalized();
  return { normal.cross((t.b - t.a).normalized()), normal.cross((t.c - t.b).normalized()),
    normal.cross((t.a - t.c).normalized()) };
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

bool liesOn(const Triangle& triangle, const Vector3& point, double tolerance)
{
  const auto corners = cornersOf(triangle);
  const auto inward = inwardOf(triangle);
  bool isOn = std::abs(triangle.areaVector().normalized().dot(point - triangle.a)) <= tolerance;
  for (std::size_t i = 0; i < 3; ++i)
  {
    isOn = isOn && inward[i].dot(point - *corners[i]) >= -4 * tolerance;
  }
  return isOn;
}

/// +1 if a mesh is on the front side of the triangle's plane alone, -1 if on the back side, else 0.
int sideOfAll(const TriangleMesh& mesh, const Triangle& triangle, double tolerance,
  const Checkpoint& checkpoint)
{
  CheckpointPace pace(checkpoint);
  const Vector3 normal = triangle.areaVector().normalized();
  bool isInFront = false, isBehind = false;
  for (const Triangle& other : mesh.triangles())
  {
    pace.step();
    for (const Vector3* corner : cornersOf(other))
    {
      const double distance = normal.dot(*corner - triangle.a);
      isInFront = isInFront || distance > 8 * tolerance;
      isBehind = isBehind || distance < -8 * tolerance;
    }
  }
  return (isInFront ? 1 : 0) - (isBehind ? 1 : 0);
}

Triangle worldTriangle(const SceneObjects& objects, const TriangleId& id)
{
  return transformed(
    objects[id.object].worldFromObject, objects[id.object].body->mesh()[id.triangle]);
}

bool isLamp(const SceneObject& object, std::uint32_t triangle)
{
  const Material& material = *object.material;
  const auto bands = static_cast<std::size_t>(material.bands);
  const auto emits = [&](std::size_t band) {
    return band < bands && material.exitance[material.cellOfTriangle[triangle] * bands + band] > 0;
  };
  return !material.exitance.empty() && (emits(0) || emits(1) || emits(2));
}

/// World bounds, slightly inflated, of a box in the space of the object.
Box worldBounds(const SceneObject& object, const Box& model)
{
  Box world = movedBox(object.worldFromObject, model);
  world.inflate(2 * kTouching * world.magnitude());
  return world;
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

/// Triangles of an object that may touch a box in the world.
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
  return irradiance::trianglesNear(object.body->tree(), Box{ center - reach, center + reach });
}

}

SolidSides solidSidesOf(const SceneObject& object, bool isStatic, const Checkpoint& checkpoint)
{
  const std::vector<Triangle>& triangles = object.body->mesh().triangles();
  std::vector<bool> lamps;
  std::vector<std::uint32_t> parts;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    lamps.push_back(isLamp(object, i));
    parts.push_back(object.material->partOfCell(object.material->cellOfTriangle[i]));
  }
  return solidSides(triangles, parts, lamps, isStatic, checkpoint);
}

void Contacts::update(const SceneObjects& objects, const Checkpoint& checkpoint)
{
  partners_.clear();
  isTouched_.assign(objects.size(), {});
  known_.resize(objects.size());
  for (std::uint32_t lamp = 0; lamp < objects.size(); ++lamp)
  {
    if (objects[lamp].material->exitance.empty() || objects[lamp].isEmpty())
    {
      continue;
    }
    addOwn(objects, lamp, checkpoint);
    for (std::uint32_t other = 0; other < objects.size(); ++other)
    {
      if (other != lamp)
      {
        addBetween(objects, lamp, other, checkpoint);
      }
    }
  }
  const auto order = [](const Partner& a, const Partner& b) { return key(a.id) < key(b.id); };
  const auto isSame = [](const Partner& a, const Partner& b) { return a.id == b.id; };
  for (auto& entry : partners_)
  {
    std::vector<Partner>& partners = entry.second.partners;
    std::sort(partners.begin(), partners.end(), order);
    partners.erase(std::unique(partners.begin(), partners.end(), isSame), partners.end());
    const auto& [object, triangle] = entry.first;
    isTouched_[object].resize(objects[object].body->mesh().size());
    isTouched_[object][triangle] = 1;
  }
}

Contacts::Known& Contacts::knownOf(const SceneObjects& objects, std::uint32_t object)
{
  known_.resize(objects.size());
  Known& known = known_[object];
  const SceneObject& own = objects[object];
  if (known.body != own.body || known.material != own.material)
  {
    known = {};
    known.body = own.body;
    known.material = own.material;
  }
  return known;
}

void Contacts::addOwn(
  const SceneObjects& objects, std::uint32_t object, const Checkpoint& checkpoint)
{
  Known& known = knownOf(objects, object);
  const SceneObject& own = objects[object];
  if (!known.hasPairs)
  {
    known.pairs.clear(); // left by an interrupted search
    const TriangleMesh& mesh = own.body->mesh();
    CheckpointPace pace(checkpoint);
    for (std::uint32_t i = 0; i < mesh.size(); ++i)
    {
      pace.step(16);
      if (!isLamp(own, i))
      {
        continue;
      }
      Box box = mesh[i].bounds();
      known.lamps.add(box);
      box.inflate(2 * kTouching * box.magnitude());
      for (const std::uint32_t k : irradiance::trianglesNear(own.body->tree(), box))
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
    add(objects, { object, i }, { object, k }, checkpoint);
  }
}

void Contacts::addBetween(const SceneObjects& objects, std::uint32_t lamp, std::uint32_t other,
  const Checkpoint& checkpoint)
{
  const Box common = worldBounds(objects[lamp], knownOf(objects, lamp).lamps)
                       .intersection(worldBounds(objects[other]));
  if (common.isEmpty())
  {
    return;
  }
  CheckpointPace pace(checkpoint);
  for (const std::uint32_t i : trianglesNear(objects[lamp], common))
  {
    pace.step(16);
    if (!isLamp(objects[lamp], i))
    {
      continue;
    }
    const Triangle triangle = worldTriangle(objects, { lamp, i });
    Box box = triangle.bounds();
    box.inflate(2 * kTouching * box.magnitude());
    for (const std::uint32_t k : trianglesNear(objects[other], box.intersection(common)))
    {
      if (doCoincide(triangle, worldTriangle(objects, { other, k })))
      {
        add(objects, { lamp, i }, { other, k }, checkpoint);
      }
    }
  }
}

void Contacts::add(const SceneObjects& objects, const TriangleId& a, const TriangleId& b,
  const Checkpoint& checkpoint)
{
  for (const auto& [self, other] : { std::pair(a, b), std::pair(b, a) })
  {
    Touched& touched = partners_[key(self)];
    touched.self = partnerOf(objects, self, checkpoint);
    touched.partners.push_back(partnerOf(objects, other, checkpoint));
  }
}

const SolidSides& Contacts::sidesOf(
  const SceneObjects& objects, std::uint32_t object, const Checkpoint& checkpoint)
{
  const SceneObject& own = objects[object];
  Known& known = knownOf(objects, object);
  if (known.sides.of.empty())
  {
    known.sides = solidSidesOf(own, object == 0, checkpoint);
  }
  return known.sides;
}

Contacts::Partner Contacts::partnerOf(
  const SceneObjects& objects, const TriangleId& id, const Checkpoint& checkpoint)
{
  const SolidSides& sides = sidesOf(objects, id.object, checkpoint);
  SolidSide side = sides.of[id.triangle];
  // A dynamic shell that encloses all static geometry, with its front inside, lines a room.
  if (id.object > 0 && side == SolidSide::InFront && sides.isOfOutermost[id.triangle] &&
    holds(worldBounds(objects[id.object]), objects.staticObject.body->mesh().bounds()))
  {
    side = SolidSide::Behind;
  }
  return { id, side, isLamp(objects[id.object], id.triangle) };
}

std::vector<Contacts::Wall> Contacts::wallsAt(
  const SceneObjects& objects, const Vector3& light, const Checkpoint& checkpoint)
{
  std::vector<Wall> walls;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    Box box{ light, light };
    box.inflate(2 * kTouching * box.magnitude());
    for (const std::uint32_t i : trianglesNear(objects[object], box))
    {
      const Triangle triangle = worldTriangle(objects, { object, i });
      const double tolerance =
        kTouching * std::max(triangle.bounds().magnitude(), light.cwiseAbs().maxCoeff());
      if (!liesOn(triangle, light, tolerance))
      {
        continue;
      }
      const SolidSides& sides = sidesOf(objects, object, checkpoint);
      const Vector3 front = triangle.areaVector().normalized();
      const int open = sides.of[i] == SolidSide::None
        ? sideOfAll(objects.staticObject.body->mesh(), triangle, tolerance, checkpoint)
        : (sides.of[i] == SolidSide::Behind ? 1 : -1);
      // A body that encloses everything can only be a room.
      const bool isRoomAfterAll = object == 0 && sides.isOfOutermost[i] &&
        sideOfAll(objects.staticObject.body->mesh(), triangle, tolerance, checkpoint) == -open;
      const Vector3 normal = (isRoomAfterAll ? -open : open) * front;
      const bool isKnown = std::any_of(walls.begin(), walls.end(),
        [&](const Wall& wall) { return (wall.normal - normal).squaredNorm() < 0x1p-40; });
      if (open != 0 && !isKnown)
      {
        walls.push_back({ normal, normal.dot(light - triangle.a), 0.5 * tolerance });
      }
    }
  }
  return walls;
}

bool Contacts::hasDynamic(const TriangleId& id) const
{
  return has(id) && (id.object > 0 || partners_.at(key(id)).partners.back().id.object > 0);
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
bool Contacts::blocks(
  const Scene& scene, const Vector3& leaving, const Partner& start, const Partner& other)
{
  const int fromStart = intoSolid(start.side, scene.worldTriangle(start.id).areaVector(), leaving);
  const int toOther = intoSolid(other.side, scene.worldTriangle(other.id).areaVector(), leaving);
  return toOther > 0 ? fromStart <= 0 : toOther == 0 && fromStart < 0;
}

/// The order in which a ray hits coincident triangles: those out of whose solid it comes, lamps
/// that face it, other sheets, lamps that face away, those into whose solid it goes.
int Contacts::rank(const Scene& scene, const Vector3& direction, const Partner& partner)
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

Hit Contacts::settled(const Scene& scene, const Ray& ray, const Hit& closest) const
{
  const Hit touching = has(ray.start) ? hitAtStart(scene, ray) : Hit{};
  return touching ? touching : has(closest.id) ? firstOf(scene, ray, closest) : closest;
}

/// The hit on the triangle that stops a ray at its start; none if the ray can leave.
Hit Contacts::hitAtStart(const Scene& scene, const Ray& ray) const
{
  const Touched& start = partners_.at(key(ray.start));
  const Triangle triangle = scene.worldTriangle(ray.start);
  const Vector3 normal = triangle.areaVector().normalized();
  const Vector3 leaving = normal.dot(ray.direction) > 0 ? normal : Vector3(-normal);
  const double step = 8 * kTouching * triangle.bounds().magnitude();
  const Ray back{ ray.origin + step * leaving, -leaving, ray.start };
  for (const Partner& partner : start.partners)
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
  const Touched& touched = partners_.at(key(closest.id));
  Hit first = closest;
  int firstRank = rank(scene, ray.direction, touched.self);
  for (const Partner& partner : touched.partners)
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
