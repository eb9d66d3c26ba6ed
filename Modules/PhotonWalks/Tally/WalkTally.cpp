#include "Tally/WalkTally.h"

namespace irradiance
{

void WalkBooking::remove(
  const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk, std::uint32_t firstBounce)
{
  Power incoming = block.power(walkInBlock, firstBounce);
  for (std::uint32_t i = firstBounce; i < block.size(walkInBlock); ++i)
  {
    const Power carriedOn = block.power(walkInBlock, i + 1); // zero behind the last
    book(walk, block.hit(walkInBlock, i), block.isFront(walkInBlock, i), incoming, carriedOn, -1);
    incoming = carriedOn;
  }
}

void WalkBooking::book(std::uint32_t walk, const Hit& hit, bool isFront, const Power& incoming,
  const Power& carriedOn, int sign)
{
  balance_.segments += sign;
  if (!hit)
  {
    sign > 0 ? balance_.escaped += incoming : balance_.escaped -= incoming;
    return;
  }
  const Power kept = incoming - carriedOn;
  sign > 0 ? balance_.absorbed += kept : balance_.absorbed -= kept;
  for (int band = 0; band < Power::kMaxBands; ++band)
  {
    balance_.received += sign * static_cast<double>(incoming[band]);
  }
  checkReceived(balance_);
  sums_.collect(walk, hit.id, isFront, incoming, sign, deposits_);
}

}
