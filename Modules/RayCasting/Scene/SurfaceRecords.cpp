// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SurfaceRecords.h"

#include <algorithm>

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
  first_ = { 0 };
  for (Origin& origin : origins)
  {
    origin.first = first_.back();
    first_.push_back(origin.first + static_cast<std::uint32_t>(origin.body->mesh().size()));
  }
  rows_.resize(size());
  origins_.resize(origins.size());
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t object = 0; object < origins.size(); ++object)
  {
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

TriangleId SurfaceRecords::idOf(std::uint32_t number) const
{
  if (number == kNone)
  {
    return {};
  }
  const auto after = std::upper_bound(first_.begin(), first_.end(), number);
  const auto object = static_cast<std::uint32_t>(after - first_.begin() - 1);
  return { object, number - first_[object] };
}

}
