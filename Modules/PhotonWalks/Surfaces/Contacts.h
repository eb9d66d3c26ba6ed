// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "Scene/Scene.h"
#include "Surfaces/CoincidentTriangles.h"
#include "Surfaces/ObjectSides.h"

#include <memory>
#include <vector>

namespace irradiance
{

/**
 * Where triangles coincide, what is solid decides which of them light leaves and hits, as rounding
 * cannot. A body that stands on a lamp receives light on the touching face, and reflects it back to
 * the lamp; none gets inside. A lamp in the plane of a wall shines into the room, and receives what
 * falls on it. A rug in the plane of a floor is lit, and the floor below it is not.
 *
 * Only triangles to which light may come are looked at, see ContactLight. Documentation/Theory.md,
 * section 3, has the rules.
 */
class Contacts
{
public:
  /// Updates the contacts to a frame. `moved`: the dynamic objects that have moved since the last
  /// one; empty: nothing is known of it. `sides`: where solid sides are found.
  void update(const SceneObjects& objects, const std::vector<bool>& moved, ObjectSides& sides,
    Execution& execution);

  bool isEmpty() const { return contacts_.empty(); }
  bool has(const TriangleId& id) const { return numberOf(id) != kNone; }
  /// Whether the triangle touches another and one of the two is dynamic.
  bool hasDynamic(const TriangleId& id) const
  {
    const std::uint32_t number = numberOf(id);
    return number != kNone && contacts_[number].isDynamic;
  }

  /// Whether that holds for any triangle.
  bool hasDynamic() const { return hasDynamic_; }

  /// Calls visit(id) for each lamp that coincides with a triangle, in order.
  template <class Visit>
  void forEachLampAt(const TriangleId& id, const Visit& visit) const
  {
    if (const std::uint32_t number = numberOf(id); number != kNone)
    {
      for (const std::uint32_t lamp : contacts_[number].lamps)
      {
        visit(contacts_[number].partners[lamp].id);
      }
    }
  }

  /// The hit of a ray whose closest hit among all triangles is `closest`. Its distance is 0 where
  /// the ray cannot leave its start.
  Hit resolveContact(const Scene& scene, const Ray& ray, const Hit& closest) const;

private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  using Pair = std::pair<TriangleId, TriangleId>;
  struct ContactTriangle
  {
    TriangleId id;
    SolidSide side;
    bool isRoom, isLamp;
    std::uint32_t shell; ///< of the object
    double size;         ///< of that shell in the world
  };
  struct Contact
  {
    ContactTriangle self;
    std::vector<ContactTriangle> partners;    ///< ordered by object and triangle
    std::vector<std::uint32_t> lamps;         ///< among the partners
    std::shared_ptr<const TriangleTree> tree; ///< over the partners, if they are many
    bool isDynamic;
  };
  /// Of a body with itself.
  struct OwnPairs
  {
    std::shared_ptr<const RigidObject> body;
    std::vector<TrianglePair> pairs;
  };
  class Meeting;

  std::uint32_t numberOf(const TriangleId& id) const
  {
    return id.object < numbers_.size() && !numbers_[id.object].empty()
      ? numbers_[id.object][id.triangle]
      : kNone;
  }
  void findWithin(const SceneObjects& objects, Execution& execution);
  void findBetween(
    const SceneObjects& objects, const std::vector<bool>& moved, const CancelPoint& cancelPoint);
  std::vector<Pair> litPairs(
    const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint) const;
  void list(const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint);
  static ContactTriangle contactTriangleOf(const SceneObjects& objects, ObjectSides& sides,
    const TriangleId& id, const CancelPoint& cancelPoint);
  static void finish(Contact& contact, const SceneObjects& objects, const CancelPoint& cancelPoint);
  template <class Visit>
  static void forEachPartnerAt(
    const Contact& contact, const Ray& ray, double distance, const Visit& visit);
  Hit hitAtStart(const Scene& scene, const Ray& ray) const;
  Hit firstOf(const Scene& scene, const Ray& ray, const Hit& closest) const;

  std::vector<OwnPairs> own_; ///< by object
  std::vector<Pair> between_;
  std::vector<Pair> lit_; ///< those of all to which light may come
  std::vector<Contact> contacts_;
  bool hasDynamic_ = false;
  std::vector<std::vector<std::uint32_t>> numbers_; ///< of contacts, by object and triangle
};

}
