// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontDescent.h"

#include <algorithm>

namespace irradiance
{

void FrontDescent::run(
  const TriangleTree& tree, const TreeRays& rays, const Rows& rows, FrontTester& tester)
{
  const std::uint32_t room = TreeRays::roomFor(rays.count);
  queries_.need(room);
  others_.need(room);
  candidate_.need(room);
  further_.need(std::size_t{ 2 } * room);
  PreparedQueries prepared{ queries_.data(), 0, others_.data(), 0 };
  frontStages().prepare(tree, rays, prepared);

  std::fill_n(candidate_.data(), room, TreeRays::kNone);
  FrontSearches searches{ &tree, prepared.queries, prepared.count, candidate_.data(),
    further_.data(), 0, static_cast<std::uint32_t>(further_.room()), rows.first, rows.bytes,
    rows.read, tester };
  frontStages().search(searches);
  furtherCount_ = searches.furtherCount;
  for (std::uint32_t i = 0; i < prepared.otherCount; ++i)
  {
    searchExactly(tree, rays, prepared.others[i], tester);
  }
}

}
