// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Kernels/ConfirmLanes.h"
#include "Kernels/FrontStages.h"
#include "Kernels/IntersectionLanes.h"
#include "Kernels/QueryCounts.h"
#include "Kernels/TreeQuery.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"
#include "Trees/KdTree.h"

#include <algorithm>
#include <cstring>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "Kernels/Avx2Lanes.inl"
#include "Kernels/FrontStages.inl"
#include "Kernels/WideQuery.inl"

namespace irradiance
{

std::uint32_t pickFrontAvx2(
  const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked)
{
  return pickRays(rays, filter, picked);
}

std::uint32_t findNearAvx2(const TreeRays& rays, const BodyBalls& balls, NearRays* found)
{
  return findNearRays<Avx2Lanes>(rays, balls, found);
}

void prepareFrontAvx2(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries)
{
  prepareRays(tree, rays, queries);
}

void searchFrontAvx2(FrontSearches& searches)
{
  runSearches<Avx2Lanes, Avx2Lanes>(searches);
}

void confirmFrontAvx2(
  const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners)
{
  confirmRays(rays, candidate, corners);
}

void intersectAllAvx2(IntersectionLanes& lanes)
{
  lanes.intersect();
}

}

IRRADIANCE_TARGET_END

#endif
