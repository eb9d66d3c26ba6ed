// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/FrontStages.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

std::uint32_t pickFront(const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked)
{
  return IRRADIANCE_CALL_BEST(pickFront, rays, filter, picked);
}

std::uint32_t findNear(const TreeRays& rays, const BodyBalls& balls, NearRays* found)
{
  return IRRADIANCE_CALL_BEST(findNear, rays, balls, found);
}

void prepareFront(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries)
{
  IRRADIANCE_CALL_BEST(prepareFront, tree, rays, queries);
}

void searchFront(FrontSearches& searches)
{
  IRRADIANCE_CALL_BEST(searchFront, searches);
}

void confirmFront(const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners)
{
  IRRADIANCE_CALL_BEST(confirmFront, rays, candidate, corners);
}

}
