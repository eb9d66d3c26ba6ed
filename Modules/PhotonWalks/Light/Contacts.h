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
 * Where surfaces coincide with lamps: which of them light leaves and meets is decided by what is solid,
 * as rounding cannot tell. A body that stands on a lamp takes the light on the face that touches, and
 * gives it back to the lamp; none gets inside. A lamp in the plane of a wall shines into the room, and
 * receives what falls on it.
 *
 * Coincident are triangles of which one lies within twice the margin of SurfacePoint of the other's
 * plane, and which overlap. Documentation/Theory.md, section 3, says what holds.
 */
class Contacts
{
public:
  /// Brings it up to date with a frame. Within an object that has not changed nothing is looked for
  /// again.
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
    Vector3 normal;  ///< unit vector to the side where light can be
    double distance; ///< of the point, along the normal
    double margin;   ///< as in SurfacePoint
  };
  /// The walls in whose plane a point light lies; none of those that let it shine to both sides.
  std::vector<Wall> wallsAt(
    const SceneObjects& objects, const Vector3& light, const Checkpoint& checkpoint);

  /// The hit of a ray whose closest hit among all triangles is `closest`. Its distance is 0 where the
  /// ray cannot leave its start.
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
  /// Of an object with itself, while it keeps its mesh and its surface; and its solid sides, if needed.
  struct Known
  {
    std::shared_ptr<const RigidObject> body;
    std::shared_ptr<const Material> material;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    Box lamps;             ///< bounds of its lamps, in the space of the object
    bool hasPairs = false; ///< `pairs` and `lamps` are complete
    SolidSides sides;      ///< empty until it is needed
  };

  static Key key(const TriangleId& id) { return { id.object, id.triangle }; }
  /// What is known of an object as it is now, perhaps nothing yet.
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

}

#endif
