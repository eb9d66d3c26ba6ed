// SPDX-License-Identifier: BSD-3-Clause
#include "History/GridSegments.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

void placeOnGrid(const PointGrid& grid, const RayColumns& rays, std::size_t first,
  std::size_t count, GridSegments& segments)
{
  IRRADIANCE_CALL_BEST(placeOnGrid, grid, rays, first, count, segments);
}

}
