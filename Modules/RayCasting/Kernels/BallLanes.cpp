// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/BallLanes.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

unsigned passingOfPlain(const BallLanes& lanes, const Ball& ball)
{
  return lanes.passing(ball);
}

unsigned passingOf(const BallLanes& lanes, const Ball& ball)
{
  return IRRADIANCE_CALL_BEST(passingOf, lanes, ball);
}

}
