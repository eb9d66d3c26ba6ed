// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontStages_h
#define irradiance_FrontStages_h

#include "Kernels/BodyBalls.h"
#include "Kernels/IntersectionLanes.h"
#include "Kernels/PrepareLanes.h"

#include <algorithm>

namespace irradiance
{

/// The stages of a cast in one tree, compiled for one instruction set. All find the same hits, bit
/// for bit.
struct FrontStages
{
  /// Writes the rays that may touch the ellipsoid to `picked`, with room for all; returns their
  /// number.
  std::uint32_t (*pick)(const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked);
  /// Writes which rays may touch which ball to `found`, with room for as many for every kLeastLanes
  /// rays as there are balls; returns their number. More may be near than the ellipsoids let pass.
  std::uint32_t (*findNear)(const TreeRays& rays, const BodyBalls& balls, NearRays* found);
  /// Sets the queries and the other rays.
  void (*prepare)(const TreeRays& rays, FrontSearches& searches);
  void (*search)(FrontSearches& searches);
  /// Tests the triangle `candidate[i]`, unless it is kNone, for each ray i, and keeps the closer
  /// hits.
  void (*confirm)(const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners);
  void (*intersect)(IntersectionLanes& lanes);
};

/// By the best instructions of the machine.
const FrontStages& frontStages();
const FrontStages& frontStagesPlain();
const FrontStages& frontStagesAvx2();
const FrontStages& frontStagesAvx512();

/// Tests so many rays with a triangle each, eight at a time, and keeps the closer hits. set(i,
/// lanes, lane) sets a lane to the i-th test, and returns its ray and the triangle's number.
template <class Set>
void confirmEach(const TreeRays& rays, std::size_t count, const Set& set)
{
  constexpr std::size_t kSize = IntersectionLanes::kSize;
  IntersectionLanes lanes;
  FurtherCandidate tests[kSize];
  for (std::size_t first = 0; first < count; first += kSize)
  {
    const auto some = static_cast<unsigned>(std::min(count - first, kSize));
    for (unsigned lane = 0; lane < some; ++lane)
    {
      tests[lane] = set(first + lane, lanes, lane);
    }
    frontStages().intersect(lanes);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      rays.keepCloser(tests[lane].ray, tests[lane].reference, lanes.distance[lane],
        lanes.weightB[lane], lanes.weightC[lane]);
    }
  }
}

/// Searches for one of the rays that floats cannot follow, all in double. The tree must not be
/// empty.
void searchExactly(
  const TriangleTree& tree, const TreeRays& rays, std::uint32_t ray, FrontTester& tester);

}

#endif
