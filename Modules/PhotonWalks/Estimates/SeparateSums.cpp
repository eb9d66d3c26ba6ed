// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/SeparateSums.h"

namespace irradiance
{

std::optional<CellSums> gatheredSums(
  const WalkSets& walks, const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  const CellSums& all = walks.sums();
  std::optional<CellSums> gathered;
  PowerBalance balance; // is known already
  for (const WalkSet& set : walks.sets())
  {
    set.forEachGathered([&](const GatheredLight& light) {
      gathered ? void() : void(gathered.emplace(objects, all.sides(), all.plan(), all.rounds()));
      light.addTo(*gathered, balance, DealtBlocks(), 1, cancelPoint);
    });
  }
  return gathered;
}

std::optional<SeparateSums> separateSums(
  const WalkSets& walks, const SceneObjects& objects, std::size_t rounds, Execution& execution)
{
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  const std::optional<CellSums> gathered = gatheredSums(walks, objects, cancelPoint);
  if (!gathered)
  {
    return std::nullopt;
  }
  const CellSums& all = walks.sums();
  const std::uint32_t replicates = all.plan().replicates().count();
  const std::uint32_t count = walks.plan().walksAfter(rounds);
  const WalkPlan plan(count, count, replicates);
  SeparateSums separate{ CellSums(objects, all.sides(), plan),
    CellSums(objects, all.sides(), plan) };
  ThrottledCancelPoint pace(cancelPoint);
  all.numbers().forEach([&](const SceneCell& cell) {
    for (int side = 0; side < all.sides(); ++side)
    {
      for (int band = 0; band < all.bands(); ++band)
      {
        for (std::uint32_t i = 0; i < replicates; ++i)
        {
          const CellSide part{ cell, side };
          const std::int64_t direct = gathered->sum(part, band, i, rounds);
          separate.direct.set(part, band, i, direct);
          separate.indirect.set(part, band, i, all.sum(part, band, i, rounds) - direct);
        }
      }
    }
    pace.step();
  });
  return separate;
}

}
