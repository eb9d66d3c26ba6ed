// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SurfaceRecords_h
#define irradiance_SurfaceRecords_h

#include "Geometry/Ray.h"
#include "Meshes/SurfaceRecord.h"
#include "Progress/CancelPoint.h"
#include "Scene/PlacedBody.h"

#include <memory>
#include <vector>

namespace irradiance
{

/**
 * The surface records of all triangles of a scene in world space, object after object. So each triangle
 * has one number: that of the first triangle of its object, plus its own. Object 0, the static one, comes
 * first. The order of numbers is the order of ids, by which ties of hits are broken.
 *
 * A body that is not there in a frame keeps its numbers.
 */
class SurfaceRecords
{
public:
  static constexpr std::uint32_t kNone = TriangleId::kNone;

  /// Makes the records of what is new, and makes those of objects anew whose body or pose is another.
  void update(const std::shared_ptr<const RigidObject>& staticBody,
    const std::vector<PlacedBody>& dynamicObjects, const CancelPoint& cancelPoint = {});

  std::uint32_t size() const { return first_.back(); }
  const SurfaceRecord* rows() const { return rows_.data(); }
  const SurfaceRecord& operator[](std::uint32_t number) const { return rows_[number]; }
  /// The number of the object's first triangle.
  std::uint32_t first(std::uint32_t object) const { return first_[object]; }

  /// Of an id that is none, kNone.
  std::uint32_t numberOf(const TriangleId& id) const
  {
    return id.object == TriangleId::kNone ? kNone : first_[id.object] + id.triangle;
  }
  TriangleId idOf(std::uint32_t number) const;

private:
  /// What the records of an object were made of.
  struct Origin
  {
    std::shared_ptr<const RigidObject> body;
    AffineMap worldFromObject;
    std::uint32_t first = 0;

    bool operator==(const Origin& other) const
    {
      return body == other.body && worldFromObject == other.worldFromObject && first == other.first;
    }
  };

  void fill(const Origin& origin, bool isStatic, ThrottledCancelPoint& pace);

  std::vector<Origin> origins_;              ///< by object; without a body where nothing is known
  std::vector<std::uint32_t> first_ = { 0 }; ///< by object, and the number of all
  std::vector<SurfaceRecord> rows_;
};

}

#endif
