// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/SideSums.h"

#include "Execution/ProgressSpan.h"
#include "Execution/SlicedPass.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// Blocks whose photons are added together.
constexpr std::size_t kTogether = 16;

}

SideSums::SideSums(const WalkSets& walks, const SceneObjects& objects, Execution& execution)
  : walks_(walks)
{
  const CellSums& all = walks.sums();
  if (all.sides() == 2)
  {
    return;
  }
  counted_.emplace(objects, 2, all.plan(), all.rounds(), all.gatherers());
  const auto sets = static_cast<double>(walks.sets().size());
  double done = 0;
  for (const WalkSet& set : walks.sets())
  {
    ProgressSpan part(execution, done / sets, (done + 1) / sets);
    count(set, objects, part);
    ++done;
  }
}

void SideSums::count(const WalkSet& set, const SceneObjects& objects, Execution& execution)
{
  const WalkHistory& history = set.history();
  // Its walks have numbers of their own.
  const CellSums& its = set.sums();
  CellSums sums(objects, 2, its.plan(), its.rounds(), its.gatherers());
  SlicedPass pass{ (history.size() + kTogether - 1) / kTogether, {} };
  pass.work = [&](std::size_t unit, const Deadline&) {
    std::vector<Deposit> deposits;
    for (std::size_t i = unit * kTogether; i < std::min((unit + 1) * kTogether, history.size());
         ++i)
    {
      history.forEachPhoton(i, [&](const Photon& photon) {
        sums.collect(sums.slotOf(photon.reference.walk, sums.cellOf(photon.id)), photon.isFront,
          history.power(photon.reference), 1, deposits);
      });
    }
    sums.add(deposits);
    return true;
  };
  pass.run(execution);
  const CancelPoint cancelPoint = cancelPointOf(execution, 1);
  PowerBalance balance; // is known already
  set.forEachGathered(
    [&](const DirectGather& light) { light.addTo(sums, balance, DealtBlocks(), 1, cancelPoint); });
  counted_->add(sums, cancelPoint);
}

}
