// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Contacts.h"

#include "Surfaces/ContactLight.h"
#include "Trees/LeafQuery.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace irradiance
{

namespace
{

/// Partners of a triangle from which on they stand in a tree.
constexpr std::size_t kMany = 16;

bool hasMoved(const std::vector<bool>& moved, std::uint32_t object)
{
  return moved.empty() || (object > 0 && moved[object - 1]);
}

/// Calls visit(i, k), i < k, for all objects whose bounds touch if one of them has moved.
template <class Visit>
void forEachNeighbours(
  const SceneObjects& objects, const std::vector<bool>& moved, const Visit& visit)
{
  std::vector<Box> bounds;
  Box all;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    bounds.push_back(touchedBox(objects[i].worldBounds()));
    all.add(bounds.back());
  }
  int axis;
  all.extent().maxCoeff(&axis);
  std::vector<std::uint32_t> order(objects.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
    return std::make_pair(bounds[i].lower[axis], i) < std::make_pair(bounds[k].lower[axis], k);
  });
  for (std::size_t first = 0; first < order.size(); ++first)
  {
    const std::uint32_t i = order[first];
    for (std::size_t next = first + 1;
         next < order.size() && bounds[order[next]].lower[axis] <= bounds[i].upper[axis]; ++next)
    {
      const std::uint32_t k = order[next];
      if ((hasMoved(moved, i) || hasMoved(moved, k)) &&
        !bounds[i].intersection(bounds[k]).isEmpty())
      {
        visit(std::min(i, k), std::max(i, k));
      }
    }
  }
}

/// A measure of a surface's area in the world by which surfaces that differ by rounding are alike.
double sizeOf(const SceneObject& object, const Shell& shell)
{
  // The cube of the area, as then a pose of scale s gives exactly s^6.
  const double scale = object.worldFromObject.linear.determinant();
  int exponent;
  const double mantissa =
    std::frexp(0.6 * shell.area * shell.area * shell.area * scale * scale, &exponent);
  return std::ldexp(std::floor(mantissa * 1024), exponent);
}

/// +1 if the direction leads into the solid of a triangle with this normal, -1 if out of it, 0 for
/// sheets.
int intoSolid(SolidSide side, bool isFront)
{
  return side == SolidSide::None ? 0 : (side == SolidSide::Behind) == isFront ? 1 : -1;
}

}

void Contacts::update(const SceneObjects& objects, const std::vector<bool>& moved,
  ObjectSides& sides, Execution& execution)
{
  ProgressSpan still(execution, 0, 0);
  const CancelPoint cancelPoint = cancelPointOf(still, 0);
  findWithin(objects, still);
  findBetween(objects, moved, cancelPoint);
  std::vector<Pair> lit = litPairs(objects, sides, cancelPoint);
  const bool isMoved = std::any_of(lit.begin(), lit.end(), [&](const Pair& pair) {
    return hasMoved(moved, pair.first.object) || hasMoved(moved, pair.second.object);
  });
  if (moved.empty() || isMoved || lit != lit_)
  {
    lit_ = std::move(lit);
    list(objects, sides, cancelPoint);
  }
}

/// A body that another has replaced is searched again.
void Contacts::findWithin(const SceneObjects& objects, Execution& execution)
{
  own_.resize(objects.size());
  std::vector<std::uint32_t> unknown;
  std::vector<const RigidObject*> bodies;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    if (objects[i].isPresent && own_[i].body != objects[i].body)
    {
      unknown.push_back(i);
      bodies.push_back(objects[i].body.get());
    }
  }
  std::vector<std::vector<TrianglePair>> found = coincidentWithin(bodies, execution);
  for (std::size_t i = 0; i < unknown.size(); ++i)
  {
    own_[unknown[i]] = { objects[unknown[i]].body, std::move(found[i]) };
  }
}

void Contacts::findBetween(
  const SceneObjects& objects, const std::vector<bool>& moved, const CancelPoint& cancelPoint)
{
  between_.erase(std::remove_if(between_.begin(), between_.end(),
                   [&](const Pair& pair) {
                     return hasMoved(moved, pair.first.object) ||
                       hasMoved(moved, pair.second.object);
                   }),
    between_.end());
  forEachNeighbours(objects, moved, [&](std::uint32_t i, std::uint32_t k) {
    for (const auto& [first, second] : coincidentBetween(objects[i], objects[k], cancelPoint))
    {
      between_.push_back({ { i, first }, { k, second } });
    }
  });
  std::sort(between_.begin(), between_.end());
}

std::vector<Contacts::Pair> Contacts::litPairs(
  const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint) const
{
  std::vector<Pair> lit;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    for (std::size_t k = 0; objects[i].isPresent && k < own_[i].pairs.size(); ++k)
    {
      lit.push_back({ { i, own_[i].pairs[k].first }, { i, own_[i].pairs[k].second } });
    }
  }
  lit.insert(lit.end(), between_.begin(), between_.end());
  if (lit.empty())
  {
    return lit; // as in most scenes: looking for lamps would cost time
  }
  ContactLight light(objects, sides, cancelPoint);
  ThrottledCancelPoint pace(cancelPoint);
  const auto isDark = [&](const Pair& pair) {
    pace.step(16);
    return !light.mayCome(pair.first, pair.second);
  };
  lit.erase(std::remove_if(lit.begin(), lit.end(), isDark), lit.end());
  return lit;
}

void Contacts::list(const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint)
{
  contacts_.clear();
  hasDynamic_ = false;
  numbers_.assign(objects.size(), {});
  for (const auto& [s, t] : lit_)
  {
    for (const auto& [self, other] : { std::pair(s, t), std::pair(t, s) })
    {
      std::vector<std::uint32_t>& numbers = numbers_[self.object];
      numbers.resize(objects[self.object].body->mesh().size(), kNone);
      std::uint32_t& number = numbers[self.triangle];
      if (number == kNone)
      {
        number = static_cast<std::uint32_t>(contacts_.size());
        contacts_.push_back(
          { contactTriangleOf(objects, sides, self, cancelPoint), {}, {}, {}, self.isDynamic() });
      }
      Contact& contact = contacts_[number];
      contact.partners.push_back(contactTriangleOf(objects, sides, other, cancelPoint));
      contact.isDynamic = contact.isDynamic || other.isDynamic();
    }
  }
  for (Contact& contact : contacts_)
  {
    finish(contact, objects, cancelPoint);
    hasDynamic_ = hasDynamic_ || contact.isDynamic;
  }
}

Contacts::ContactTriangle Contacts::contactTriangleOf(const SceneObjects& objects,
  ObjectSides& allSides, const TriangleId& id, const CancelPoint& cancelPoint)
{
  const SceneObject& object = objects[id.object];
  const SolidSides& sides = allSides.of(objects, id.object, cancelPoint);
  const Shell& shell = sides.shell(id.triangle);
  // A dynamic shell with its front inside that encloses all static geometry lines a room; one that
  // lies in another thing, a cavity.
  const bool isAround = shell.isOutermost && !objects.staticObject.isEmpty() &&
    holds(object.worldBounds(), objects.staticObject.body->mesh().bounds());
  const bool isLining = id.object > 0 && sides.of[id.triangle] == SolidSide::InFront &&
    (isAround || linesAnother(objects, id.object, shell, allSides, cancelPoint));
  return { id, isLining ? SolidSide::Behind : sides.of[id.triangle], shell.isRoom || isLining,
    object.isLamp(id.triangle), sides.shellOf[id.triangle], sizeOf(object, shell) };
}

void Contacts::finish(Contact& contact, const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  std::sort(contact.partners.begin(), contact.partners.end(),
    [](const ContactTriangle& a, const ContactTriangle& b) { return a.id < b.id; });
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < contact.partners.size(); ++i)
  {
    ContactTriangle& partner = contact.partners[i];
    if (partner.isLamp)
    {
      contact.lamps.push_back(i);
    }
    // Where a surface folds onto itself there is no matter between.
    if (partner.id.object == contact.self.id.object && partner.shell == contact.self.shell)
    {
      partner.side = contact.self.side = SolidSide::None;
    }
    if (contact.partners.size() >= kMany)
    {
      boxes.push_back(worldTriangle(objects, partner.id).bounds());
    }
  }
  if (!boxes.empty())
  {
    contact.tree = std::make_shared<TriangleTree>(boxes, 0, cancelPoint);
  }
}

/// The triangles that coincide at one place, as a ray meets them.
class Contacts::Meeting
{
public:
  Meeting(const Scene& scene, const Vector3& direction)
    : scene_(scene)
    , direction_(direction)
  {
  }

  void add(const ContactTriangle& triangle, const Hit& hit)
  {
    const bool isFront = scene_.worldTriangle(triangle.id).areaVector().dot(direction_) < 0;
    const int into = intoSolid(triangle.side, isFront);
    entersRoom_ = entersRoom_ || (triangle.isRoom && into < 0);
    leavesRoom_ = leavesRoom_ || (triangle.isRoom && into > 0);
    all_.push_back({ &triangle, hit, into, isFront });
  }
  /// The hit that comes first.
  const Hit& first() const
  {
    return std::min_element(all_.begin(), all_.end(), [&](const Entry& a, const Entry& b) {
      return orderOf(a) < orderOf(b);
    })->hit;
  }
  /// The last of the hits that come before the first triangle that was added, each one of another
  /// kind of matter; none if there is none.
  Hit lastBefore() const
  {
    const Entry* last = nullptr;
    for (const Entry& entry : all_)
    {
      if (layerOf(entry) < layerOf(all_.front()) && (!last || orderOf(*last) < orderOf(entry)))
      {
        last = &entry;
      }
    }
    return last ? last->hit : Hit{};
  }

private:
  struct Entry
  {
    const ContactTriangle* triangle;
    Hit hit;
    int into;
    bool isFront;
  };

  /// First those out of whose solid the ray comes; then lamps that face it, other sheets, lamps
  /// that face away; last those into whose solid it goes. Between two rooms that share a wall it
  /// goes into the wall of the room in which it is, and out of the other's.
  int rankOf(const Entry& entry) const
  {
    const bool isShared = entersRoom_ && leavesRoom_, isRoom = entry.triangle->isRoom;
    if (entry.into != 0)
    {
      return entry.into < 0 ? (isShared && isRoom ? 6 : 0) : (isShared && !isRoom ? 5 : 4);
    }
    return !entry.triangle->isLamp ? 2 : entry.isFront ? 1 : 3;
  }
  /// Sheets do not stop what leaves other sheets.
  int layerOf(const Entry& entry) const { return entry.into == 0 ? 1 : rankOf(entry); }
  /// What is smaller lies on what is larger; of what is as large, what faces the ray.
  std::tuple<int, double, bool, TriangleId> orderOf(const Entry& entry) const
  {
    return { rankOf(entry), entry.triangle->size, !entry.isFront, entry.triangle->id };
  }

  const Scene& scene_;
  const Vector3& direction_;
  std::vector<Entry> all_;
  bool entersRoom_ = false, leavesRoom_ = false;
};

/// Partners near a place.
template <class Visit>
void Contacts::forEachPartnerAt(
  const Contact& contact, const Ray& ray, double distance, const Visit& visit)
{
  if (!contact.tree)
  {
    std::for_each(contact.partners.begin(), contact.partners.end(), visit);
    return;
  }
  const Vector3 place = ray.origin + distance * ray.direction;
  Box box{ place, place };
  box.inflate(
    2 * kTouching * std::max(place.cwiseAbs().maxCoeff(), ray.origin.cwiseAbs().maxCoeff()));
  forEachNear(*contact.tree, box, [&](std::uint32_t i) { visit(contact.partners[i]); });
}

Hit Contacts::resolveContact(const Scene& scene, const Ray& ray, const Hit& closest) const
{
  const Hit touching = has(ray.start) ? hitAtStart(scene, ray) : Hit{};
  return touching ? touching : has(closest.id) ? firstOf(scene, ray, closest) : closest;
}

/// The hit on the triangle that stops a ray at its start; none if the ray can leave. It can if a
/// ray that comes from there would hit the start before all others.
Hit Contacts::hitAtStart(const Scene& scene, const Ray& ray) const
{
  const Contact& start = contacts_[numberOf(ray.start)];
  const Triangle triangle = scene.worldTriangle(ray.start);
  const Vector3 normal = triangle.areaVector().normalized();
  const Vector3 leaving = normal.dot(ray.direction) > 0 ? normal : Vector3(-normal);
  const double step = 8 * kTouching * triangle.bounds().magnitude();
  const Ray back{ ray.origin + step * leaving, -leaving, ray.start };
  Meeting meeting(scene, back.direction);
  meeting.add(start.self, {});
  forEachPartnerAt(start, back, step, [&](const ContactTriangle& partner) {
    if (Hit hit = scene.hitOf(back, partner.id))
    {
      hit.distance = 0;
      meeting.add(partner, hit);
    }
  });
  return meeting.lastBefore();
}

/// Of the closest triangle and those that coincide with it, the one that the ray hits first.
Hit Contacts::firstOf(const Scene& scene, const Ray& ray, const Hit& closest) const
{
  const Contact& touched = contacts_[numberOf(closest.id)];
  Meeting meeting(scene, ray.direction);
  meeting.add(touched.self, closest);
  forEachPartnerAt(touched, ray, closest.distance, [&](const ContactTriangle& partner) {
    if (partner.id != ray.start)
    {
      if (const Hit hit = scene.hitOf(ray, partner.id))
      {
        meeting.add(partner, hit);
      }
    }
  });
  return meeting.first();
}

}
