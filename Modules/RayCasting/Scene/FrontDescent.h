// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontDescent_h
#define irradiance_FrontDescent_h

#include "Kernels/FrontStages.h"
#include "Meshes/TriangleMesh.h"
#include "Simd/Column.h"

#include <vector>

namespace irradiance
{

/**
 * The first stages of a cast in one tree, each a loop over all rays: prepare and search. The first
 * reference that a search finds goes to a column, others, which are few, to a list; what must be
 * tested at once to test(). Rays that floats cannot follow are searched in double, one by one.
 *
 * Owns the memory of the stages, which is used again from call to call.
 */
class FrontDescent : private FrontTester
{
protected:
  /// `corners`: what lies in memory for references, to prefetch.
  void descend(const TriangleTree& tree, const TreeRays& rays, const CornerRows& corners);

  Column<std::uint32_t> candidate_; ///< by ray, the first found, or kNone; to TreeRays::roomFor()
  Column<FurtherCandidate> further_;
  std::uint32_t furtherCount_ = 0;

private:
  Column<PreparedQuery> queries_;
  Column<std::uint32_t> others_;
};

/// The closest hits of rays in a tree of one object: what is found is confirmed in double, first the
/// column, then the list.
class FrontSearch final : private FrontDescent
{
public:
  /// `rays`: in the space of the body, with the best hits so far, which are replaced by closer
  /// ones. `corners`: of the triangles of the mesh, to the bit.
  void run(const TriangleTree& tree, const TriangleMesh& mesh, const TreeRays& rays,
    const CornerRows& corners);

private:
  void test(std::uint32_t ray, std::uint32_t reference) override;

  const TriangleMesh* mesh_ = nullptr; ///< during a run
  TreeRays rays_;
};

/// What rays may hit in a tree whose triangles, or bodies, are tested elsewhere: pairs of a ray and
/// a reference.
class FrontPairs final : private FrontDescent
{
public:
  using Pair = FurtherCandidate;

  /// The pairs, in no order; one may occur more than once. Nothing is sought behind the rays' best
  /// hits.
  const std::vector<Pair>& find(const TriangleTree& tree, const TreeRays& rays);
  /// Of bodies, by their balls, which see no hits. No pair occurs twice.
  const std::vector<Pair>& find(const BodyBalls& balls, const TreeRays& rays);

private:
  void test(std::uint32_t ray, std::uint32_t reference) override
  {
    pairs_.push_back({ ray, reference });
  }

  std::vector<Pair> pairs_;
  Column<NearRays> near_;
};

}

#endif
