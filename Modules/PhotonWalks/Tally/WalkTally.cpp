// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/WalkTally.h"

namespace irradiance
{

void WalkTally::remove(
  const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk, std::uint32_t firstBounce)
{
  const std::uint32_t size = block.size(walkInBlock);
  for (std::uint32_t i = firstBounce; i < size; ++i)
  {
    const Hit hit = block.hit(walkInBlock, i);
    const Power incoming = block.power(walkInBlock, i);
    --balance_.segments;
    if (!hit)
    {
      balance_.escaped -= incoming;
      continue;
    }
    const Power outgoing = i + 1 < size ? block.power(walkInBlock, i + 1) : Power{};
    balance_.absorbed -= incoming - outgoing;
    balance_.received -= incoming.total();
    sums_.collect(sums_.slotOf(walk, hit.id.object, sums_.cellOf(hit.id)),
      block.isFront(walkInBlock, i), incoming, -1, deposits_);
  }
}

}
