// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Contacts_h
#define irradiance_Contacts_h

#include "Light/SceneObjects.h"
#include "Meshes/SolidSides.h"
#include "Scene/Scene.h"

#include <map>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * Where triangles coincide with lamps, what is solid decides which of them light leaves and hits,
 * as rounding cannot. A body that stands on a lamp receives light on the touching face, and
 * reflects it back to the lamp; none gets inside. A lamp in the plane of a wall shines into the
 * room, and receives what falls on it.
 *
 * Triangles coincide if they overlap and one lies within twice SurfacePoint::clearance of the other's
 * plane. Documentation/Theory.md, section 3, has the rules.
 */
class Contacts
{
public:
  /// Updates the contacts to a frame. Those within an object that has not changed are not searched
  /// for again.
  void update(const SceneObjects& objects, const Checkpoint& checkpoint);

  bool isEmpty() const { return partners_.empty(); }
  bool has(const TriangleId& id) const
  {
    return id.object < isTouched_.size() && !isTouched_[id.object].empty() &&
      isTouched_[id.object][id.triangle] != 0;
  }
  /// Whether the triangle touches another and one of the two is dynamic.
  bool hasDynamic(const TriangleId& id) const;

  /// A wall in whose plane a point lies.
  struct Wall
  {
    Vector3 normal;   ///< unit vector to the side where light can be
    double distance;  ///< from the plane to the point, along the normal
    double clearance; ///< distance from the plane at which light starts, as in SurfacePoint
  };
  /// The walls in whose plane a point light lies, except those that let it shine to both sides.
  std::vector<Wall> wallsAt(
    const SceneObjects& objects, const Vector3& light, const Checkpoint& checkpoint);

  /// The hit of a ray whose closest hit among all triangles is `closest`. Its distance is 0 where
  /// the ray cannot leave its start.
  Hit settled(const Scene& scene, const Ray& ray, const Hit& closest) const;

private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  struct Partner
  {
    TriangleId id;
    SolidSide side;
    bool isLamp;
  };
  struct Touched
  {
    Partner self;
    std::vector<Partner> partners; ///< ordered by object and triangle
  };
  /// Contacts of an object with itself, and its solid sides. They hold for this body and material.
  struct Known
  {
    std::shared_ptr<const RigidObject> body;
    std::shared_ptr<const Material> material;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    Box lamps;             ///< bounds of its lamps, in the space of the object
    bool hasPairs = false; ///< `pairs` and `lamps` are complete
    SolidSides sides;      ///< empty until they are needed
  };

  static Key key(const TriangleId& id) { return { id.object, id.triangle }; }
  /// What is known of an object in its present state; it may be empty.
  Known& knownOf(const SceneObjects& objects, std::uint32_t object);
  void addOwn(const SceneObjects& objects, std::uint32_t object, const Checkpoint& checkpoint);
  void addBetween(const SceneObjects& objects, std::uint32_t lamp, std::uint32_t other,
    const Checkpoint& checkpoint);
  void add(const SceneObjects& objects, const TriangleId& a, const TriangleId& b,
    const Checkpoint& checkpoint);
  const SolidSides& sidesOf(
    const SceneObjects& objects, std::uint32_t object, const Checkpoint& checkpoint);
  Partner partnerOf(
    const SceneObjects& objects, const TriangleId& id, const Checkpoint& checkpoint);
  Hit hitAtStart(const Scene& scene, const Ray& ray) const;
  Hit firstOf(const Scene& scene, const Ray& ray, const Hit& closest) const;
  static bool blocks(
    const Scene& scene, const Vector3& leaving, const Partner& start, const Partner& other);
  static int rank(const Scene& scene, const Vector3& direction, const Partner& partner);

  std::map<Key, Touched> partners_;
  std::vector<std::vector<char>> isTouched_; ///< for each triangle of the objects that touch others
  std::vector<Known> known_;
};

/// The solid sides of an object's triangles, in its own space. The static object may hold rooms.
SolidSides solidSidesOf(const SceneObject& object, bool isStatic, const Checkpoint& checkpoint);

}

#endif
