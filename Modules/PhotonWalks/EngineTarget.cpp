// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/ProgressSpan.h"
#include "IrradianceEngine.h"

#include <algorithm>

/// How the engine reaches its target: which rounds of walks it shoots, and which it drops.
namespace irradiance
{

void IrradianceEngine::reachTarget(Execution& execution)
{
  double progress = 0;
  std::size_t rounds = 0;
  do
  {
    if (rounds == sums_.rounds())
    {
      // Fewer walks may have been expected before. Progress then waits rather than going back.
      const double expected = expectedWalks(rounds);
      const double from = std::max(progress, plan_.rounds()[rounds].firstWalk / expected);
      progress = std::max(from, plan_.rounds()[rounds].endWalk / expected);
      ProgressSpan span(execution, from, progress);
      shootRound(rounds, span);
    }
    ++rounds;
    checkReceived(balance_);
    ProgressSpan still(execution, progress, progress);
    spreadSums(rounds, still);
    reached_ = errorEstimate(rounds).relativeErrorOfMostArea(cells_, still);
  } while (reached_ > settings_.targetRelativeError && rounds < plan_.rounds().size());
  dropRounds(rounds, checkpointOf(execution, progress));
  if (!execution.reportProgress(1))
  {
    throw Interrupted();
  }
}

double IrradianceEngine::expectedWalks(std::size_t rounds) const
{
  const double most = plan_.most(), next = plan_.rounds()[rounds].endWalk;
  if (rounds == 0)
  {
    return most;
  }
  // The error falls with the square root of the number of walks.
  const double ratio = reached_ / settings_.targetRelativeError;
  return std::clamp(plan_.rounds()[rounds - 1].endWalk * ratio * ratio, next, most);
}

void IrradianceEngine::dropRounds(std::size_t kept, const Checkpoint& checkpoint)
{
  const std::size_t blocks = plan_.rounds()[kept - 1].endBlock;
  if (history_.size() > blocks)
  {
    forgetPhotonStores();
  }
  while (history_.size() > blocks)
  {
    WalkTally tally(sums_, balance_);
    const WalkBlock& last = history_.block(history_.size() - 1);
    for (std::uint32_t walk = last.firstWalk(); walk < last.endWalk(); ++walk)
    {
      balance_.emitted -= last.power({ walk, 0 });
      tally.remove(last, { walk, 0 });
    }
    history_.removeLast();
    checkpoint();
  }
  sums_.setRounds(kept, checkpoint);
}

}
