// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/PowerBalance.h"

#include <array>
#include <stdexcept>

namespace irradiance
{

PowerBalance& PowerBalance::operator+=(const PowerBalance& other)
{
  emitted += other.emitted;
  absorbed += other.absorbed;
  escaped += other.escaped;
  unmet += other.unmet;
  segments += other.segments;
  received += other.received;
  return *this;
}

void sumOver(Ranks& ranks, PowerBalance& balance)
{
  for (Power* power : { &balance.emitted, &balance.absorbed, &balance.escaped, &balance.unmet })
  {
    ranks.sum(power->quanta.data(), power->quanta.size());
  }
  constexpr double kUnit = 0x1p20; // so that the sum of many ranks does not overflow
  std::array<std::int64_t, 2> counts{ balance.segments,
    static_cast<std::int64_t>(balance.received / kUnit) };
  ranks.sum(counts.data(), counts.size());
  balance.segments = counts[0];
  balance.received = kUnit * static_cast<double>(counts[1]);
  checkReceived(balance);
}

void checkReceived(const PowerBalance& balance)
{
  if (balance.received > 0x1p62)
  {
    throw std::overflow_error("the cells receive more than 2^16 times the emitted power: the "
                              "reflectances of a closed scene are too near 1");
  }
}

void addLocked(const PowerBalance& part, PowerBalance& total, std::mutex& mutex)
{
  const std::lock_guard<std::mutex> lock(mutex);
  total += part;
  checkReceived(total);
}

}
