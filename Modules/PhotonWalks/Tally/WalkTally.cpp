// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/WalkTally.h"

namespace irradiance
{

void WalkTally::remove(
  const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk, std::uint32_t firstBounce)
{
  Power incoming = block.power(walkInBlock, firstBounce);
  for (std::uint32_t i = firstBounce; i < block.size(walkInBlock); ++i)
  {
    const Power reflectedPower = block.power(walkInBlock, i + 1); // zero after the last
    add(
      walk, block.hit(walkInBlock, i), block.isFront(walkInBlock, i), incoming, reflectedPower, -1);
    incoming = reflectedPower;
  }
}

void WalkTally::add(std::uint32_t walk, const Hit& hit, bool isFront, const Power& incoming,
  const Power& reflectedPower, int sign)
{
  balance_.segments += sign;
  if (!hit)
  {
    sign > 0 ? balance_.escaped += incoming : balance_.escaped -= incoming;
    return;
  }
  const Power kept = incoming - reflectedPower;
  sign > 0 ? balance_.absorbed += kept : balance_.absorbed -= kept;
  for (int band = 0; band < Power::kMaxBands; ++band)
  {
    balance_.received += sign * static_cast<double>(incoming[band]);
  }
  checkReceived(balance_);
  sums_.collect(walk, hit.id, isFront, incoming, sign, deposits_);
}

}
