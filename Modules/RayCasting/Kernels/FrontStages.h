// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontStages_h
#define irradiance_FrontStages_h

#include "Kernels/BallLanes.h"
#include "Kernels/EllipsoidLanes.h"
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

/// The stages of a cast in one tree, each with the best instructions of the machine. The hits found
/// are the same, bit for bit. Writes the rays that may touch the ellipsoid to `picked`, with room
/// for all; returns their number.
std::uint32_t pickFront(const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked);
/// Writes which rays may touch which ball to `found`, with room for as many for every kLeastLanes
/// rays as there are balls; returns their number. More may be near than the ellipsoids let pass.
std::uint32_t findNear(const TreeRays& rays, const BodyBalls& balls, NearRays* found);
void prepareFront(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries);
void searchFront(FrontSearches& searches);
/// Searches for one of the rays that floats cannot follow, all in double. The tree must not be
/// empty.
void searchExactly(
  const TriangleTree& tree, const TreeRays& rays, std::uint32_t ray, FrontTester& tester);
/// Tests the triangle `candidate[i]`, unless it is kNone, for each ray i, and keeps the closer
/// hits.
void confirmFront(const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners);

std::uint32_t pickFrontPlain(
  const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked);
std::uint32_t pickFrontAvx2(
  const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked);
std::uint32_t pickFrontAvx512(
  const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked);
std::uint32_t findNearPlain(const TreeRays& rays, const BodyBalls& balls, NearRays* found);
std::uint32_t findNearAvx2(const TreeRays& rays, const BodyBalls& balls, NearRays* found);
std::uint32_t findNearAvx512(const TreeRays& rays, const BodyBalls& balls, NearRays* found);
void prepareFrontPlain(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries);
void prepareFrontAvx2(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries);
void prepareFrontAvx512(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries);
void searchFrontPlain(FrontSearches& searches);
void searchFrontAvx2(FrontSearches& searches);
void searchFrontAvx512(FrontSearches& searches);
void confirmFrontPlain(
  const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners);
void confirmFrontAvx2(
  const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners);
void confirmFrontAvx512(
  const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners);

}

#endif
