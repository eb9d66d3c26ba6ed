// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/IntersectionLanes.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

void intersectAllPlain(IntersectionLanes& lanes)
{
  lanes.intersect();
}

void intersectAll(IntersectionLanes& lanes)
{
  IRRADIANCE_CALL_BEST(intersectAll, lanes);
}

}
