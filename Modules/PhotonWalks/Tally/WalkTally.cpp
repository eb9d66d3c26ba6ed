// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/WalkTally.h"

namespace irradiance
{

void WalkTally::remove(const WalkBlock& block, const SegmentRef& first)
{
  const std::uint32_t size = block.size(first.walk);
  balance_.segments -= size - first.bounce;
  forEachContribution(block, first, size, [&](const Contribution& brought) {
    const SegmentRef next{ first.walk, brought.segment.bounce + 1 };
    const Power outgoing = next.bounce < size ? block.power(next) : Power{};
    balance_.absorbed -= brought.power - outgoing;
    balance_.received -= brought.power.total();
    sums_.collect(brought, -1, deposits_);
  });
  const SegmentRef last{ first.walk, size - 1 };
  if (first.bounce < size && !block.hit(last))
  {
    balance_.escaped -= block.power(last);
  }
}

}
