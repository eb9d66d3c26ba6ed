// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontDescent.h"

#include "Kernels/TreeQuery.h"
#include "Progress/StageTimes.h"

#include <algorithm>

namespace irradiance
{

/// Rays that floats cannot follow from where they start, as searches of single rays.
class FrontDescent::OtherRays final : public QuerySource
{
public:
  OtherRays(const TriangleTree& tree, const TreeRays& rays, const PreparedQueries& prepared,
    FrontTester& tester)
    : tree_(tree)
    , rays_(rays)
    , prepared_(prepared)
    , tester_(tester)
  {
  }

  std::size_t next(QueryRequest* requests, std::size_t most) override
  {
    const std::size_t count = std::min<std::size_t>(most, prepared_.otherCount - next_);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint32_t ray = prepared_.others[next_++];
      requests[i] = { &tree_, originOf(rays_, ray), directionOf(rays_, ray), 0.0,
        rays_.distance[ray], rays_.skipped(ray, TriangleBlock::kNone), ray, false };
    }
    return count;
  }
  void begin(TreeQuery& /*query*/) override {}
  void narrow(const TreeQuery& /*query*/) override {}
  void finish(const TreeQuery& query, const std::uint32_t* references, std::size_t count) override
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      tester_.test(query.job, references[i]);
    }
  }
  void test(TreeQuery& query, std::uint32_t reference) override
  {
    tester_.test(query.job, reference);
    if (rays_.distance[query.job] < query.bound())
    {
      query.setBound(rays_.distance[query.job]);
    }
  }

private:
  const TriangleTree& tree_;
  const TreeRays& rays_;
  const PreparedQueries& prepared_;
  FrontTester& tester_;
  std::uint32_t next_ = 0;
};

void FrontDescent::run(
  const TriangleTree& tree, const TreeRays& rays, const Rows& rows, FrontTester& tester)
{
  StageClock clock;
  const std::uint32_t room = TreeRays::roomFor(rays.count);
  queries_.need(room);
  others_.need(room);
  candidate_.need(room);
  further_.need(std::size_t{ 2 } * room);
  PreparedQueries prepared{ queries_.data(), 0, others_.data(), 0 };
  prepareFront(tree, rays, prepared);
  clock.ends(Stage::Prepare);

  std::fill_n(candidate_.data(), room, TreeRays::kNone);
  FrontSearches searches{ &tree, prepared.queries, prepared.count, candidate_.data(),
    further_.data(), 0, static_cast<std::uint32_t>(further_.room()), rows.first, rows.bytes,
    rows.read, tester };
  searchFront(searches);
  furtherCount_ = searches.furtherCount;
  if (prepared.otherCount > 0)
  {
    OtherRays others(tree, rays, prepared, tester);
    runQueries(others);
  }
  clock.ends(Stage::Search);
}

}
