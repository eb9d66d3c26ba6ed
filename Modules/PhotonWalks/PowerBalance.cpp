#include "PowerBalance.h"

#include <stdexcept>

namespace irradiance
{

PowerBalance& PowerBalance::operator+=(const PowerBalance& other)
{
  emitted += other.emitted;
  absorbed += other.absorbed;
  escaped += other.escaped;
  segments += other.segments;
  received += other.received;
  return *this;
}

void checkReceived(const PowerBalance& balance)
{
  if (balance.received > 0x1p62)
  {
    throw std::overflow_error("the cells receive more than 2^16 times the emitted power: the "
                              "reflectances of a closed scene are too near 1");
  }
}

void WalkBooking::add(const WalkTrace& tail, std::uint32_t firstBounce)
{
  if (firstBounce == 0)
  {
    balance_.emitted += tail.power(0);
  }
  for (std::uint32_t i = 0; i < tail.size(); ++i)
  {
    const Power carriedOn = i + 1 < tail.size() ? tail.power(i + 1) : Power{};
    book(tail.segment(i).hit, tail.isFront(i), tail.power(i), carriedOn, 1);
  }
}

void WalkBooking::remove(const WalkBlock& block, std::uint32_t walk, std::uint32_t firstBounce)
{
  for (std::uint32_t i = firstBounce; i < block.size(walk); ++i)
  {
    const Power carriedOn = i + 1 < block.size(walk) ? block.power(walk, i + 1) : Power{};
    book(block.segment(walk, i).hit, block.isFront(walk, i), block.power(walk, i), carriedOn, -1);
  }
}

void WalkBooking::book(
  const Hit& hit, bool isFront, const Power& incoming, const Power& carriedOn, int sign)
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
  sums_.add(hit.id, isFront, incoming, sign);
}

}
