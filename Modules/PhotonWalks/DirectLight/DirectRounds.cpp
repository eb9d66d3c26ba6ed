// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DirectRounds.h"

#include "Sampling/SplitMix.h"

namespace irradiance
{

void DirectRounds::append(
  const Frame& frame, const LampPieces& lamps, std::uint32_t walks, Execution& execution)
{
  DirectGather::Settings its = settings_;
  its.walks = walks;
  its.round = rounds_.size();
  its.firstWalk = plan_.endWalk();
  its.seed = its.round == 0 ? settings_.seed : splitMix(settings_.seed + its.round);
  rounds_.push_back(std::make_unique<DirectGather>(frame, lamps, its, execution));
  plan_.addRound(rounds_.back()->starts().size());
}

void DirectRounds::addTo(
  const Totals& totals, std::size_t round, const CancelPoint& cancelPoint) const
{
  rounds_[round]->addTo(totals.sums, totals.balance, totals.dealt, 1, cancelPoint);
}

void DirectRounds::drop(std::size_t kept, const Totals& totals, const CancelPoint& cancelPoint)
{
  while (rounds_.size() > kept)
  {
    rounds_.back()->addTo(totals.sums, totals.balance, totals.dealt, -1, cancelPoint);
    rounds_.pop_back();
  }
  plan_.dropRounds(kept);
}

std::vector<std::uint32_t> DirectRounds::follow(
  const Frame& frame, const Totals& totals, Execution& execution)
{
  std::vector<std::uint32_t> walks;
  for (const std::unique_ptr<DirectGather>& light : rounds_)
  {
    const std::vector<std::uint32_t> samples = light->follow(frame, execution);
    light->change(samples, totals.sums, totals.balance, totals.dealt);
    const std::vector<std::uint32_t> some = light->starts().walksOf(samples);
    walks.insert(walks.end(), some.begin(), some.end());
  }
  return walks;
}

}
