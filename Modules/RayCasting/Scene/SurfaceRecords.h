// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/SurfacePoint.h"
#include "Progress/CancelPoint.h"
#include "Scene/RigidObject.h"
#include "Scene/TriangleNumbers.h"
#include "Simd/LargePages.h"

#include <algorithm>
#include <memory>
#include <utility>
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
    const std::vector<PlacedBody>& dynamicObjects, const CancelPoint& cancelPoint = {})
  {
    std::vector<Origin> origins = { { staticBody, AffineMap{}, 0 } };
    for (const PlacedBody& object : dynamicObjects)
    {
      origins.push_back({ object.body, object.worldFromObject, 0 });
    }
    std::vector<std::size_t> sizes;
    sizes.reserve(origins.size());
    for (const Origin& origin : origins)
    {
      sizes.push_back(origin.body->mesh().size());
    }
    TriangleNumbers numbers(sizes);
    rows_.resize(std::max(numbers.size(), 1u));
    numbers_ = std::move(numbers);
    origins_.resize(origins.size());
    ThrottledCancelPoint pace(cancelPoint);
    for (std::uint32_t object = 0; object < origins.size(); ++object)
    {
      origins[object].first = numbers_.first(object);
      if (!(origins_[object] == origins[object]))
      {
        origins_[object] = {}; // for the case that the work is cancelled
        fill(origins[object], object == 0, pace);
        origins_[object] = origins[object];
      }
    }
  }

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

  void fill(const Origin& origin, bool isStatic, ThrottledCancelPoint& pace)
  {
    const TriangleMesh& mesh = origin.body->mesh();
    for (std::size_t i = 0; i < mesh.size(); ++i)
    {
      rows_[origin.first + i] =
        SurfaceRecord(isStatic ? mesh[i] : transformed(origin.worldFromObject, mesh[i]));
      pace.step();
    }
  }

  std::vector<Origin> origins_; ///< by object; without a body where nothing is known
  TriangleNumbers numbers_;
  std::vector<SurfaceRecord, LargePages<SurfaceRecord>> rows_{ SurfaceRecord{} };
};

}
