// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SurfaceRecords.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

void SurfaceRecords::update(const std::shared_ptr<const RigidObject>& staticBody,
  const std::vector<PlacedBody>& dynamicObjects, const CancelPoint& cancelPoint)
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

void SurfaceRecords::fill(const Origin& origin, bool isStatic, ThrottledCancelPoint& pace)
{
  const TriangleMesh& mesh = origin.body->mesh();
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    rows_[origin.first + i] =
      SurfaceRecord(isStatic ? mesh[i] : transformed(origin.worldFromObject, mesh[i]));
    pace.step();
  }
}

}
