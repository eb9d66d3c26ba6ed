// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SurfaceRecords_h
#define irradiance_SurfaceRecords_h

#include "Meshes/SurfacePoint.h"
#include "Progress/CancelPoint.h"
#include "Scene/RigidObject.h"
#include "Scene/TriangleNumbers.h"
#include "Simd/LargePages.h"

#include <memory>
#include <vector>

namespace irradiance
{

/**
 * The surface records of all triangles of a scene in world space, by number.
 *
 * A body that is not there in a frame keeps its numbers and its records.
 */
class SurfaceRecords
{
public:
  /// Makes the records of what is new, and makes those of objects anew whose body or pose is
  /// another. If it throws, the next one makes up for it.
  void update(const std::shared_ptr<const RigidObject>& staticBody,
    const std::vector<PlacedBody>& dynamicObjects, const CancelPoint& cancelPoint = {});

  const TriangleNumbers& numbers() const { return numbers_; }
  std::uint32_t size() const { return numbers_.size(); }
  /// At least one, which has no meaning if there are no triangles.
  const SurfaceRecord* rows() const { return rows_.data(); }
  const SurfaceRecord& operator[](std::uint32_t number) const { return rows_[number]; }

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

  std::vector<Origin> origins_; ///< by object; without a body where nothing is known
  TriangleNumbers numbers_;
  std::vector<SurfaceRecord, LargePages<SurfaceRecord>> rows_{ SurfaceRecord{} };
};

}

#endif
