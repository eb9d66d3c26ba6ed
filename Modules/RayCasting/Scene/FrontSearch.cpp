// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontSearch.h"

#include "Kernels/IntersectionLanes.h"
#include "Progress/StageTimes.h"

#include <algorithm>

namespace irradiance
{

/// Rays that floats cannot follow from where they start, as searches of single rays.
class FrontSearch::OtherRays final : public QuerySource
{
public:
  OtherRays(FrontSearch& owner, std::uint32_t count)
    : owner_(owner)
    , count_(count)
  {
  }

  std::size_t next(QueryRequest* requests, std::size_t most) override
  {
    const std::size_t count = std::min<std::size_t>(most, count_ - next_);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint32_t ray = owner_.others_[next_++];
      requests[i] = { &owner_.body_->tree(), owner_.origin(ray), owner_.direction(ray), 0.0,
        owner_.rays_.distance[ray], owner_.rays_.skipped(ray, TriangleBlock::kNone), ray, false };
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
    if (owner_.rays_.distance[query.job] < query.bound())
    {
      query.setBound(owner_.rays_.distance[query.job]);
    }
  }

private:
  FrontSearch& owner_;
  std::uint32_t next_ = 0, count_;
};

void FrontSearch::run(const RigidObject& body, const TreeRays& rays, const CornerRows& corners)
{
  if (rays.count == 0 || body.tree().isEmpty())
  {
    return;
  }
  body_ = &body;
  rays_ = rays;
  const std::uint32_t room = TreeRays::roomFor(rays.count);
  queries_.need(room);
  others_.need(room);
  candidate_.need(room);
  further_.need(room);
  search(corners);
}

void FrontSearch::search(const CornerRows& corners)
{
  StageClock clock;
  PreparedQueries prepared{ queries_.data(), 0, others_.data(), 0 };
  prepareFront(body_->tree(), rays_, prepared);
  clock.ends(Stage::Prepare);

  std::fill_n(candidate_.data(), TreeRays::roomFor(rays_.count), TreeRays::kNone);
  FrontSearches searches{ &body_->tree(), prepared.queries, prepared.count, candidate_.data(),
    further_.data(), 0, static_cast<std::uint32_t>(further_.room()),
    reinterpret_cast<const char*>(corners.first), corners.stride * sizeof(double),
    9 * sizeof(double), *this };
  searchFront(searches);
  if (prepared.otherCount > 0)
  {
    OtherRays others(*this, prepared.otherCount);
    runQueries(others);
  }
  clock.ends(Stage::Search);

  confirmFront(rays_, candidate_.data(), corners);
  confirmFurther(searches.furtherCount);
  clock.ends(Stage::Confirm);
}

void FrontSearch::confirmFurther(std::uint32_t count)
{
  IntersectionLanes lanes;
  for (std::uint32_t first = 0; first < count; first += IntersectionLanes::kSize)
  {
    const std::uint32_t some = std::min<std::uint32_t>(count - first, IntersectionLanes::kSize);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      const auto& [ray, reference] = further_[first + lane];
      lanes.set(lane, origin(ray), direction(ray), body_->mesh()[reference]);
    }
    intersectAll(lanes);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      const auto& [ray, reference] = further_[first + lane];
      rays_.keepCloser(ray, rays_.first + reference, lanes.distance[lane], lanes.weightB[lane],
        lanes.weightC[lane]);
    }
  }
}

void FrontSearch::test(std::uint32_t ray, std::uint32_t reference)
{
  double distance;
  Vector3 weights;
  if (ShearedRay(origin(ray), direction(ray))
        .intersects(body_->mesh()[reference], distance, &weights))
  {
    rays_.keepCloser(ray, rays_.first + reference, distance, weights[1], weights[2]);
  }
}

}
