// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/IntersectionLanes.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

void intersectAll(IntersectionLanes& lanes)
{
#ifdef __x86_64__
  switch (simdLevel())
  {
    case SimdLevel::Avx512:
      return intersectAllAvx512(lanes);
    case SimdLevel::Avx2:
      return intersectAllAvx2(lanes);
    case SimdLevel::Plain:
      break;
  }
#endif
  lanes.intersect();
}

}
