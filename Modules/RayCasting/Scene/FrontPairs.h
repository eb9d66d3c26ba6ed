// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontPairs_h
#define irradiance_FrontPairs_h

#include "Scene/FrontDescent.h"

#include <vector>

namespace irradiance
{

/**
 * What rays may hit in a tree whose triangles, or bodies, are tested elsewhere: pairs of a ray and
 * a reference.
 *
 * Owns its memory, which is used again from call to call.
 */
class FrontPairs final : private FrontTester
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
  FrontDescent descent_;
  Column<NearRays> near_;
};

}

#endif
