// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontStages_h
#define irradiance_FrontStages_h

#include "Kernels/BodyBalls.h"
#include "Kernels/IntersectionLanes.h"
#include "Kernels/PrepareLanes.h"

namespace irradiance
{

/// Tests triangles at once, in double: few, where there is no room for more candidates or floats do
/// not serve.
class FrontTester
{
public:
  virtual void test(std::uint32_t ray, std::uint32_t reference) = 0;

protected:
  ~FrontTester() = default;
};

/// A triangle that a search found beside the first.
struct FurtherCandidate
{
  std::uint32_t ray, reference;
};

/// Searches of a front in one tree, and where they write what they find.
struct FrontSearches
{
  const TriangleTree* tree;
  const PreparedQuery* queries;
  std::uint32_t count;
  std::uint32_t* candidate; ///< by ray, the first found
  FurtherCandidate* further;
  std::uint32_t furtherCount, furtherRoom;
  const char* rows;        ///< of the triangles, to prefetch
  std::size_t rowBytes;    ///< from one to the next
  std::size_t cornerBytes; ///< of one, that the test reads
  FrontTester& tester;
};

/// The corners of triangles, nine doubles, at equal distances in memory.
struct CornerRows
{
  const double* first;
  std::size_t stride; ///< doubles from one to the next

  const double* of(std::uint32_t triangle) const { return first + triangle * stride; }
};

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
  void (*prepare)(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries);
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

/// Searches for one of the rays that floats cannot follow, all in double. The tree must not be
/// empty.
void searchExactly(
  const TriangleTree& tree, const TreeRays& rays, std::uint32_t ray, FrontTester& tester);

}

#endif
