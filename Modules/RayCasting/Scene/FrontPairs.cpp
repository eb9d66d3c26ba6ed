// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontPairs.h"

#include "Kernels/TreeQuery.h"
#include "Progress/StageTimes.h"

#include <algorithm>

namespace irradiance
{

/// Rays that floats cannot follow from where they start, as searches of single rays.
class FrontPairs::OtherRays final : public QuerySource
{
public:
  OtherRays(FrontPairs& owner, const TriangleTree& tree, const TreeRays& rays, std::uint32_t count)
    : owner_(owner)
    , tree_(tree)
    , rays_(rays)
    , count_(count)
  {
  }

  std::size_t next(QueryRequest* requests, std::size_t most) override
  {
    const std::size_t count = std::min<std::size_t>(most, count_ - next_);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint32_t ray = owner_.others_[next_++];
      const Vector3 origin(rays_.origin[0][ray], rays_.origin[1][ray], rays_.origin[2][ray]);
      const Vector3 direction(
        rays_.direction[0][ray], rays_.direction[1][ray], rays_.direction[2][ray]);
      requests[i] = { &tree_, origin, direction, 0.0, rays_.distance[ray],
        rays_.skipped(ray, TriangleBlock::kNone), ray, false };
    }
    return count;
  }
  void begin(TreeQuery& /*query*/) override {}
  void narrow(const TreeQuery& /*query*/) override {}
  void finish(const TreeQuery& query, const std::uint32_t* references, std::size_t count) override
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      owner_.test(query.job, references[i]);
    }
  }
  void test(TreeQuery& query, std::uint32_t reference) override
  {
    owner_.test(query.job, reference);
  }

private:
  FrontPairs& owner_;
  const TriangleTree& tree_;
  const TreeRays& rays_;
  std::uint32_t next_ = 0, count_;
};

const std::vector<FrontPairs::Pair>& FrontPairs::find(
  const TriangleTree& tree, const TreeRays& rays)
{
  pairs_.clear();
  if (rays.count > 0 && !tree.isEmpty())
  {
    search(tree, rays);
  }
  return pairs_;
}

void FrontPairs::search(const TriangleTree& tree, const TreeRays& rays)
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

  std::fill_n(candidate_.data(), rays.count, TreeRays::kNone);
  // Nothing is worth to be prefetched: what is found waits in a list.
  FrontSearches searches{ &tree, prepared.queries, prepared.count, candidate_.data(),
    further_.data(), 0, static_cast<std::uint32_t>(further_.room()),
    reinterpret_cast<const char*>(tree.blocks()), 0, 1, *this };
  searchFront(searches);
  if (prepared.otherCount > 0)
  {
    OtherRays others(*this, tree, rays, prepared.otherCount);
    runQueries(others);
  }
  for (std::uint32_t ray = 0; ray < rays.count; ++ray)
  {
    if (candidate_[ray] != TreeRays::kNone)
    {
      pairs_.push_back({ ray, candidate_[ray] });
    }
  }
  pairs_.insert(pairs_.end(), further_.data(), further_.data() + searches.furtherCount);
  clock.ends(Stage::Search);
}

}
