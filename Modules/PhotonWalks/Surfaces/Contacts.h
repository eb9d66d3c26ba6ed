// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Contacts_h
#define irradiance_Contacts_h

#include "Scene/Scene.h"
#include "Surfaces/ObjectSides.h"
#include "Surfaces/SceneObjects.h"

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
  /// for again. `sides`: where the solid sides of touching objects are found.
  void update(const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint);

  bool isEmpty() const { return contacts_.empty(); }
  bool has(const TriangleId& id) const
  {
    return id.object < isTouched_.size() && !isTouched_[id.object].empty() &&
      isTouched_[id.object][id.triangle] != 0;
  }
  /// Whether the triangle touches another and one of the two is dynamic.
  bool hasDynamic(const TriangleId& id) const;

  /// Calls visit(id) for each lamp that coincides with a triangle, in order.
  template <class Visit>
  void forEachLampAt(const TriangleId& id, const Visit& visit) const
  {
    if (has(id))
    {
      for (const ContactTriangle& partner : contacts_.at(key(id)).partners)
      {
        if (partner.isLamp)
        {
          visit(partner.id);
        }
      }
    }
  }

  /// The hit of a ray whose closest hit among all triangles is `closest`. Its distance is 0 where
  /// the ray cannot leave its start.
  Hit resolveContact(const Scene& scene, const Ray& ray, const Hit& closest) const;

private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  struct ContactTriangle
  {
    TriangleId id;
    SolidSide side;
    bool isLamp;
  };
  struct Contact
  {
    ContactTriangle self;
    std::vector<ContactTriangle> partners; ///< ordered by object and triangle
  };
  /// Contacts of an object with itself.
  struct ObjectContacts
  {
    SceneObject object; ///< as it was
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    Box lamps;             ///< bounds of its lamps, in the space of the object
    bool hasPairs = false; ///< `pairs` and `lamps` are complete
  };
  /// What finds the contacts of a frame.
  struct Search
  {
    const SceneObjects& objects;
    ObjectSides& sides;
    const CancelPoint& cancelPoint;
  };

  static Key key(const TriangleId& id) { return { id.object, id.triangle }; }
  void addOwn(const Search& search, std::uint32_t object);
  void addBetween(const Search& search, std::uint32_t lamp, std::uint32_t other);
  void add(const Search& search, const TriangleId& a, const TriangleId& b);
  static ContactTriangle contactTriangleOf(const Search& search, const TriangleId& id);
  Hit hitAtStart(const Scene& scene, const Ray& ray) const;
  Hit firstOf(const Scene& scene, const Ray& ray, const Hit& closest) const;
  static bool blocks(const Scene& scene, const Vector3& leaving, const ContactTriangle& start,
    const ContactTriangle& other);
  static int rank(const Scene& scene, const Vector3& direction, const ContactTriangle& partner);

  std::map<Key, Contact> contacts_;
  std::vector<std::vector<char>> isTouched_; ///< for each triangle of the objects that touch others
  std::vector<ObjectContacts> known_;
};

}

#endif
