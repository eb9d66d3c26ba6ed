// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Kernels/BallLanes.h"
#include "Kernels/IntersectionLanes.h"
#include "Kernels/QueryCounts.h"
#include "Kernels/TreeQuery.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"
#include "Trees/KdTree.h"

#include <algorithm>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "Kernels/Avx2Lanes.inl"
#include "Kernels/WideQuery.inl"

namespace irradiance
{

void runQueriesAvx2(QuerySource& source)
{
  runInTurns<Avx2Lanes, Avx2Lanes>(source);
}

void intersectAllAvx2(IntersectionLanes& lanes)
{
  lanes.intersect();
}

unsigned passingOfAvx2(const BallLanes& lanes, const Ball& ball)
{
  return lanes.passing(ball);
}

}

IRRADIANCE_TARGET_END

#endif
